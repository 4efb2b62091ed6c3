// SPDX-License-Identifier: MIT
#include "tests/view/picture.hpp"

namespace splash::tests {

void show_page(Chromium& browser, const std::string& url,
               const std::function<std::string()>& words) {
  browser.call("Page.navigate", {{"url", url}});
  EXPECT_TRUE(browser.wait_for("window.splash && splash.pictures() > 2", kTimeout))
      << (words ? words() : url);
  browser.evaluate(
      "for (const one of document.querySelectorAll('header, #hint, nav, #panel, footer')) "
      "one.style.visibility = 'hidden'");
}

Json seen(Chromium& browser, const Json& places) {
  return browser.evaluate(R"js((async (places) => {
    const { transform } = await import('/vector.js');
    const { both } = splash.camera.matrices();
    return places.map((place) => {
      const [x, y] = transform(both, place);
      return [(0.5 + 0.5 * x) * innerWidth, (0.5 - 0.5 * y) * innerHeight];
    });
  }))js" + ("(" + places.dump() + ")"));
}

Json drawn(Chromium& browser, const Json& places) {
  // Asked for behind the page's own picture, it comes after it, while the canvas still holds it.
  // Where the page drew none, since graphics were not done with the last, the canvas is black: look
  // again.
  return browser.evaluate(R"js(((places) => new Promise((done) => {
    const look = () => requestAnimationFrame(() => {
      const canvas = document.getElementById('water');
      const gl = canvas.getContext('webgl2');
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      const { width, height } = canvas;
      const pixels = new Uint8Array(4 * width * height);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      const dense = width / innerWidth;
      const colours = places.map(([x, y]) => {
        const at = 4 * (Math.round(x * dense) + width * Math.round(height - 1 - y * dense));
        return [...pixels.slice(at, at + 3)];
      });
      if (colours.flat().some((value) => value > 0)) done(colours);
      else look();
    });
    look();
  })))js" + ("(" + places.dump() + ")"));
}

Json way_down(Chromium& browser) {
  return seen(browser, browser.evaluate(R"((async () => {
    const { add, cross, scale } = await import('/vector.js');
    const { camera } = splash;
    const right = cross(camera.forward, [0, 0, 1]).map((x) => x / Math.cos(camera.elevation));
    const up = cross(right, camera.forward);
    return [[0, 0, 0.35], add([0, 0, 0.35], scale(up, -0.3))];
  })())"));
}

double turquoise(const Json& colour) {
  return colour[1].get<double>() - colour[0].get<double>();
}

}  // namespace splash::tests
