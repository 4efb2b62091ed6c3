// SPDX-License-Identifier: MIT
// Each member of a scene's structs is filled by one row of a table, or is named here as one that
// the reader fills itself.
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <type_traits>
#include <variant>

#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {
namespace {

/// Converts to anything, so that a braced list of them fits a struct of as many members.
struct Anything {
  template <class Type>
  operator Type() const;  // NOLINT(google-explicit-constructor)
};

template <class Struct, class... Members>
consteval std::size_t member_count() {
  if constexpr (requires { Struct{Members{}..., Anything{}}; }) {
    return member_count<Struct, Members..., Anything>();
  } else {
    return sizeof...(Members);
  }
}

/// Expects each member of `Struct`, and of `Entry`, its form as spelled, to be filled once: by a
/// row, or by the reader's own code where it is among `others`.
template <class Struct, class Entry, class... Others>
void expect_each_filled(const Fields<Entry>& fields, Others... others) {
  const Entry entry;
  const auto* const first = reinterpret_cast<const std::byte*>(static_cast<const Struct*>(&entry));
  std::set<const std::byte*> filled = {
      reinterpret_cast<const std::byte*>(&(static_cast<const Struct&>(entry).*others))...};
  EXPECT_EQ(filled.size(), sizeof...(Others));
  std::size_t spelled = 0;
  for (const auto& field : fields) {
    const auto* const place = std::visit(
        [&](auto member) { return reinterpret_cast<const std::byte*>(&(entry.*member)); },
        field.member);
    EXPECT_TRUE(filled.insert(place).second) << field.row.key << " fills what is filled already";
    if (place < first || place >= first + sizeof(Struct)) ++spelled;
  }
  EXPECT_EQ(filled.size() - spelled, member_count<Struct>()) << "a member has no row, or a row";
  if constexpr (!std::is_same_v<Struct, Entry>) {
    EXPECT_EQ(spelled + 1, member_count<Entry>()) << "a word of the entry has no row";
  }
}

TEST(SceneMembers, OfTheWholeAreFilled) {
  expect_each_filled<Scene>(scene_fields(), &Scene::fluid, &Scene::tank, &Scene::slope,
                            &Scene::wave_maker, &Scene::tank_motion, &Scene::water, &Scene::gate,
                            &Scene::flow, &Scene::bodies, &Scene::frictions, &Scene::gauges,
                            &Scene::detect, &Scene::skip, &Scene::serve, &Scene::tracking);
  expect_each_filled<SkipSettings>(skip_fields());
  expect_each_filled<ServeSettings>(serve_fields());
}

TEST(SceneMembers, OfTheWaterAreFilled) {
  expect_each_filled<FluidSettings>(fluid_fields(), &FluidSettings::solver, &FluidSettings::kernels,
                                    &FluidSettings::settle);
  expect_each_filled<WaterBlock>(water_fields(), &WaterBlock::form);
  expect_each_filled<Flow>(flow_fields(), &Flow::kind);
  expect_each_filled<DetectSettings>(detect_fields());
}

TEST(SceneMembers, OfTheTankAreFilled) {
  expect_each_filled<Tank>(tank_fields());
  expect_each_filled<Slope>(slope_fields(), &Slope::present);
  expect_each_filled<WaveMaker>(wave_maker_fields(), &WaveMaker::present);
  expect_each_filled<TankMotionSettings>(tank_motion_fields(), &TankMotionSettings::present,
                                         &TankMotionSettings::samples);
  expect_each_filled<TankSample>(tank_sample_fields());
  expect_each_filled<Gate>(gate_fields(), &Gate::present);
}

TEST(SceneMembers, OfBodiesAreFilled) {
  expect_each_filled<BodySettings>(body_fields(), &BodySettings::shape, &BodySettings::rest,
                                   &BodySettings::centre, &BodySettings::motion);
  expect_each_filled<Shape>(shape_fields(), &Shape::kind, &Shape::mesh);
  expect_each_filled<MeshEntry>(mesh_fields());
  expect_each_filled<Keyframe>(rest_fields(), &Keyframe::time);
  expect_each_filled<Keyframe>(keyframe_fields());
  expect_each_filled<MotionSettings>(motion_fields(), &MotionSettings::kind,
                                     &MotionSettings::keyframes, &MotionSettings::file,
                                     &MotionSettings::gap, &MotionSettings::coupling,
                                     &MotionSettings::held, &MotionSettings::hover);
  expect_each_filled<PairFriction>(friction_fields(), &PairFriction::one, &PairFriction::other);
}

TEST(SceneMembers, OfGaugesAreFilled) {
  expect_each_filled<GaugesSettings>(gauges_fields(), &GaugesSettings::probes);
  expect_each_filled<GaugeSettings>(gauge_fields(), &GaugeSettings::kind, &GaugeSettings::axis,
                                    &GaugeSettings::sign, &GaugeSettings::body,
                                    &GaugeSettings::rides);
}

TEST(SceneMembers, OfTrackersAreFilled) {
  expect_each_filled<TrackingSettings>(tracking_fields(), &TrackingSettings::sources,
                                       &TrackingSettings::floor);
  expect_each_filled<TrackerEntry>(tracker_fields());
  expect_each_filled<FloorSettings>(floor_fields(), &FloorSettings::present);
  expect_each_filled<Keyframe>(mount_fields(), &Keyframe::time);
}

}  // namespace
}  // namespace splash::sim
