// SPDX-License-Identifier: MIT
// The page's modules, without the page: what they make of times and places that the test gives
// them.
#include <gtest/gtest.h>

#include "tests/view/played_page.hpp"

namespace splash::tests {
namespace {

class Modules : public InABrowser {
 protected:
  static Json with_the_modules(const std::string& script) {
    PlayedPage& page = PlayedPage::shared();
    page.load_modules();
    return page.browser().evaluate(script);
  }
};

// Pictures come 60 times a second and take 25 ms to be drawn, states 60 times, each up to 5 ms
// before its moment or 24 ms after.
TEST_F(Modules, ShownPicturesAreYoungWhereFramesComeInTime) {
  const Json seen = with_the_modules(R"js((async () => {
    const { Playout } = await import('/playout.js');
    const [ages, least] = [[], []];
    for (const late of [-0.005, 0.005, 0.02]) {
      const playout = new Playout();
      for (let k = 0; k < 600; ++k) {
        const now = 100 + k / 60;
        const jitter = 0.004 * Math.sin(7 * k);
        playout.push({ moment: now - late - jitter, count: 1 }, now);
        const begun = now + 0.008;
        playout.finished(playout.at(begun).moment, begun, begun + 0.025);
      }
      ages.push(playout.age);
      least.push(playout.leastAge - late);
    }
    return [ages, least];
  })())js");
  const Json& ages = seen[0];
  for (const Json& age : ages) EXPECT_LT(age.get<double>(), 0.060) << ages;
  EXPECT_LT(ages[0].get<double>(), ages[2].get<double>());
  // Begun 8 ms after the latest state, which was 4 ms later than the mean.
  for (const Json& age : seen[1]) EXPECT_NEAR(age.get<double>(), 0.004 + 0.008 + 0.025, 0.001);
}

// For a minute, every eighth frame of 10 ms of sound comes so many seconds late. In the second half
// of it no sample is missing, and the ring holds on average what such a frame needs, and 25 ms at
// most.
TEST_F(Modules, SoundWaitsAsLongAsTheLatestArrivalNeeds) {
  const Json heard = with_the_modules(R"js((async () => {
    Object.assign(globalThis, { sampleRate: 48000, currentTime: 0,
      AudioWorkletProcessor: class { port = { postMessage() {} }; },
      registerProcessor: (name, made) => { globalThis.Monitor = made; } });
    await import('/monitor_worklet.js');
    const heard = [];
    for (const late of [0, 0.02, 0.05]) {
      const monitor = new Monitor();
      const samples = new Float32Array(960).fill(0.5);
      const [left, right] = [new Float32Array(128), new Float32Array(128)];
      let [came, gaps, fill] = [0, 0, 0];
      for (let k = 0; k < 60 * 375; ++k) {
        const now = k / 375;
        // Each eighth frame is as late as they get, and those behind it wait for it.
        while (came * 0.01 + (came % 8 === 0 ? late : 0) <= now) {
          monitor.take({ samples, rate: 48000, moment: came * 0.01, first: 480 * came });
          came += 1;
        }
        monitor.process(null, [[left, right]]);
        if (now < 30) continue;
        gaps += left.some((sample) => sample < 0.4) ? 1 : 0;
        fill += monitor.written - monitor.read;
      }
      heard.push({ late, gaps, fill: fill / (30 * 375 * 48000) });
    }
    return heard;
  })())js");
  for (const Json& ring : heard) {
    EXPECT_EQ(ring["gaps"], 0) << ring;
    EXPECT_LT(ring["fill"].get<double>(), ring["late"].get<double>() + 0.025) << ring;
  }
}

// From the side, from above and straight down; wide and upright windows; flat and high tanks.
TEST_F(Modules, TheWholeTankIsFramedFromEveryElevation) {
  const Json framed = with_the_modules(R"js((async () => {
    const { Camera } = await import('/camera.js');
    const { transform } = await import('/vector.js');
    const framed = [];
    for (const aspect of [0.5, 1, 2]) for (const elevation of [0.03, 0.47, 1.5]) {
      for (const upper of [[2, 2, 0.5], [0.5, 0.5, 0.8]]) {
        const camera = Object.assign(new Camera(), { aspect, elevation });
        camera.frame({ lower: [0, 0, 0], upper }, -0.7, 0.85);
        const { both } = camera.matrices();
        const seen = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) =>
          transform(both, upper.map((x, i) => (bits & (1 << i) ? x : 0))));
        const [xs, ys] = [0, 1].map((i) => seen.map((place) => place[i]));
        framed.push({ aspect, elevation, upper, nearest: camera.distance === camera.size,
          side: Math.max(...xs.map(Math.abs)), bottom: Math.min(...ys), top: Math.max(...ys) });
      }
    }
    return framed;
  })())js");
  EXPECT_EQ(framed.size(), 18U);
  for (const Json& one : framed) {
    const double side = one["side"];
    const double bottom = one["bottom"];
    const double top = one["top"];
    EXPECT_LT(side, 0.94) << one;
    EXPECT_GT(bottom, -0.70) << one;
    EXPECT_LT(top, 0.85) << one;
    EXPECT_TRUE(one["nearest"].get<bool>() || side > 0.85 || top - bottom > 1.35)
        << "as large as there is room for " << one;
  }
}

// Eight particles between x = y = 0 and 1 m, in the middle but for two near the x wall, one of
// which flies, and one in a corner.
TEST_F(Modules, OnlyWaterNearWallsAndDropsAreDrawnSeveralTimes) {
  const Json drawn = with_the_modules(R"js((async () => {
    const { several, WORDS } = await import('/several.js');
    const places = [[0.5, 0.5], [0.01, 0.5], [0.99, 0.5], [0.99, 0.01], [0.5, 0.5], [0.5, 0.5],
      [0.5, 0.5], [0.5, 0.5]];
    const particles = new Uint16Array(4 * places.length);
    places.forEach(([x, y], i) =>
      particles.set([1000 * x, 1000 * y, 500, i === 2 ? 4 << 8 : 0], 4 * i));
    const state = { count: 8, lower: [0, 0, 0], unit: 0.001,
      particles: new Uint8Array(particles.buffer) };
    const tank = { lower: [0, 0, 0], upper: [1, 1, 1] };
    const { mirrored, drops } = several({ older: state, newer: state },
      { tank, paddle: 0, spacing: 0.01 });
    const placed = (points) => Array.from({ length: points.count }, (_, k) =>
      [points.used[WORDS * k] & 0xffff, points.used[WORDS * k + 4]]);
    return [placed(mirrored), placed(drops)];
  })())js");
  EXPECT_EQ(drawn[0], Json({{10, 0}, {990, 0}, {990, 1}, {990, 2}}));
  EXPECT_EQ(drawn[1], Json({{990, 10}, {990, 11}, {990, 12}, {990, 13}, {990, 14}}));
}

// A block of 1,728 points, not quite in rows, of which each second is drawn as a disc: every pixel
// has the speed and the distance of the nearest disc over its middle.
TEST_F(Modules, PointsAreDrawnWhereTheyAreTheNearestBeforeTheOthers) {
  const Json points = with_the_modules(R"js((async () => {
    const { Camera } = await import('/camera.js');
    const { Splats } = await import('/splats.js');
    const { transform } = await import('/vector.js');
    const camera = Object.assign(new Camera(), { aspect: 1.5, elevation: 0.4 });
    camera.frame({ lower: [0, 0, 0], upper: [1.2, 1.2, 1.2] }, -0.7, 0.85);
    const matrices = camera.matrices();
    const [side, radius, width, height] = [12, 0.05, 240, 160];
    const particles = new Uint16Array(4 * side ** 3);
    for (let i = 0; i < side ** 3; ++i) {
      [i % side, Math.floor(i / side) % side, Math.floor(i / side ** 2)].forEach((at, axis) => {
        particles[4 * i + axis] = 1000 * (0.1 * at + 0.02 * Math.sin(7 * i + axis));
      });
      particles[4 * i + 3] = i % 251;
    }
    const state = { count: side ** 3, lower: [0, 0, 0], unit: 0.001,
      particles: new Uint8Array(particles.buffer) };
    const view = { older: state, newer: { ...state, lower: [0, 0, 0.1] }, share: 0.5 };
    const nearest = new Float32Array(width * height).fill(1e9);
    const speeds = new Uint8Array(width * height);
    const near = new Set(); // pixels on the edge of a disc, within rounding
    for (let i = 0; i < side ** 3; i += 2) {
      const [x, y, z] = [0, 1, 2].map((axis) => particles[4 * i + axis] * state.unit);
      const place = transform(matrices.both, [x, y, z + 0.05]);
      const w = matrices.both[3] * x + matrices.both[7] * y + matrices.both[11] * (z + 0.05)
        + matrices.both[15];
      const r = (0.5 * matrices.projection[5] * radius * height) / w;
      const [u, v] = [(0.5 + 0.5 * place[0]) * width, (0.5 + 0.5 * place[1]) * height];
      for (let at = 0; at < width * height; ++at) {
        const off = Math.hypot((at % width) + 0.5 - u, Math.floor(at / width) + 0.5 - v) - r;
        if (Math.abs(off) < 1e-3) near.add(at);
        if (off > 0 || nearest[at] <= w) continue;
        nearest[at] = w;
        speeds[at] = i % 251;
      }
    }
    const drawn = new Splats().draw(view, matrices, radius, { width, height }, 2);
    let [covered, wrong] = [0, 0];
    for (let at = 0; at < width * height; ++at) {
      covered += nearest[at] < 1e9 ? 1 : 0;
      const same = Math.abs(drawn.axial[at] - nearest[at]) < 1e-5
        && drawn.tone[2 * at] === speeds[at];
      wrong += same || near.has(at) ? 0 : 1;
    }
    return { covered, wrong, near: near.size };
  })())js");
  EXPECT_EQ(points["wrong"], 0) << points;
  EXPECT_GT(points["covered"], 8000) << points;
  EXPECT_LT(points["near"], 400) << points;
}

// A machine on which a picture takes a time in proportion to its pixels: pictures get coarser until
// they come often enough, and sharper again on one that is fast.
TEST_F(Modules, APictureThatTakesLongGetsCoarser) {
  const Json shares = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const pace = new Pace(null);
    const run = (seconds, whole) => { // whole: what all pixels take [s]
      for (const end = now + 1000 * seconds; now < end;) {
        const drawing = whole * pace.sharp ** 2 * (0.5 + 0.5 * pace.share ** 2);
        now += 1000 * Math.max(drawing, 1 / 60);
        pace.step(drawing);
      }
      return [pace.sharp, pace.share, pace.rate];
    };
    return [run(1, 0.001), run(3, 0.12), run(60, 0.001)];
  })())js");
  EXPECT_EQ(shares[0][0], 1) << shares;
  EXPECT_LT(shares[1][0], 1) << shares;
  EXPECT_GT(shares[1][2], 40) << shares;
  EXPECT_EQ(shares[2][0], 1) << shares;
  EXPECT_EQ(shares[2][1], 1) << shares;
}

// Simulated graphics: a picture of water takes `whole` seconds at full resolution and less in
// proportion to its pixels; a picture of points takes 2 ms.
TEST_F(Modules, PointsBecomeWaterAgainOnceThereIsTimeForIt) {
  const Json seen = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const run = (pace, seconds, whole) => {
      let tries = 0;
      let water = 0; // pictures of it
      for (const end = now + 1000 * seconds; now < end;) {
        const points = pace.isTooSlow;
        const drawing = points ? 0.002 : whole * pace.sharp ** 2 * (0.5 + 0.5 * pace.share ** 2);
        now += 1000 * Math.max(drawing, pace.every / 60);
        pace.step(drawing);
        tries += points && !pace.isTooSlow ? 1 : 0;
        water += points ? 0 : 1;
      }
      const { every, sharp, share } = pace;
      return { tries, water, points: pace.isTooSlow, every, sharp, share };
    };
    const passes = new Pace(null);
    const stays = new Pace(null);
    return [run(passes, 10, 3), run(passes, 60, 0.001), run(stays, 10, 3), run(stays, 1200, 3)];
  })())js");
  EXPECT_EQ(seen[0]["points"], true) << seen;
  EXPECT_EQ(seen[0]["every"], 2) << "leave the processor to the simulator " << seen;
  EXPECT_EQ(seen[1]["points"], false) << seen;
  EXPECT_EQ(seen[1]["every"], 1) << seen;
  EXPECT_EQ(seen[1]["sharp"], 1) << seen;
  EXPECT_EQ(seen[1]["share"], 1) << seen;
  EXPECT_EQ(seen[2]["points"], true) << seen;
  EXPECT_GE(seen[3]["tries"], 3) << seen;
  EXPECT_LE(seen[3]["tries"], 8) << "it flickers between both";
  EXPECT_LE(seen[3]["water"], 60) << seen;
}

// Where the browser says that it draws in software, no picture of water comes before ten seconds of
// points; unless the page's address wants water.
TEST_F(Modules, SoftwareBeginsWithPoints) {
  const Json seen = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const pace = new Pace(null, true);
    const begun = now;
    while (pace.isTooSlow && now < begun + 60000) {
      now += 1000 * (pace.every / 60);
      pace.step(0.002);
    }
    return [(now - begun) / 1000, new Pace(0.5, true).isTooSlow, new Pace(null).isTooSlow];
  })())js");
  EXPECT_GT(seen[0].get<double>(), 9.9);
  EXPECT_LT(seen[0].get<double>(), 12.0);
  EXPECT_EQ(seen[1], false);
  EXPECT_EQ(seen[2], false);
}

// Simulated graphics on which water is too slow. A picture of all points takes 28 ms, less in
// proportion to the points that are drawn; states are `state` seconds old when a picture is begun.
TEST_F(Modules, FewerPointsAreDrawnWherePicturesWouldBeTooOld) {
  const Json seen = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    return [0.02, 0.045].map((state) => {
      const pace = new Pace(null);
      const strides = [];
      for (const end = now + 60000; now < end;) {
        const drawing = pace.isTooSlow ? 0.028 / pace.stride : 3;
        now += 1000 * Math.max(drawing, pace.every / 60);
        pace.step(drawing, state + drawing);
        if (pace.isTooSlow) strides.push(pace.stride);
      }
      const end = strides.slice(-300);
      return { most: Math.max(...end), least: Math.min(...end), points: pace.isTooSlow };
    });
  })())js");
  EXPECT_EQ(seen[0].dump(), R"({"least":1,"most":1,"points":true})") << "states come in time";
  EXPECT_EQ(seen[1].dump(), R"({"least":2,"most":2,"points":true})") << "it flickers";
}

// A page that is out of sight, in which the browser takes no pictures, is not a slow one.
TEST_F(Modules, ATimeWithoutPicturesIsNotASlowOne) {
  const Json pace = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const pace = new Pace(null);
    for (let i = 0; i < 60; ++i) {
      now += 1000 / 60;
      pace.step(0.005);
    }
    now += 60000;
    pace.begin();
    for (let i = 0; i < 60; ++i) {
      now += 1000 / 60;
      pace.step(0.005);
    }
    return [pace.sharp, pace.share, pace.isTooSlow];
  })())js");
  EXPECT_EQ(pace, Json({1, 1, false}));
}

// The page is often there before the simulator, which makes its kernels.
TEST_F(Modules, ASimulatorThatIsNotYetThereHasNotEnded) {
  const Json said = with_the_modules(R"js((async () => {
    const { Words } = await import('/words.js');
    const words = new Words();
    const say = (sim) => words.say({ open: true, synth: true, rests: true, sim });
    return [false, true, false].map((sim) => [say(sim).text.split(' ')[0], say(sim).bad]);
  })())js");
  EXPECT_EQ(said.dump(), R"([["Waiting",false],["The",false],["No",true]])");
}

}  // namespace
}  // namespace splash::tests
