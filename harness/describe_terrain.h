#pragma once

#include "reckon/harness/describe_choices.h"
#include "reckon/harness/describe_traits.h"

namespace reckon::harness {

template <class Archive>
void Describe(Archive& a, sim::GroundContactConfig& c) {
  using Contact = sim::GroundContactConfig;
  a.Field("time_constant_s", c.time_constant_s, "How slowly it springs back",
          Within(Contact::kTimeConstant));
  a.Field("damping_ratio", c.damping_ratio, "1: without overshoot", Within(Contact::kDampingRatio));
  a.Field("impedance_min", c.impedance_min, "Hardness where a foot only touches, 0 to 1",
          Within(Contact::kImpedance));
  a.Field("impedance_max", c.impedance_max, "and where it has sunk in",
          Within(Contact::kImpedance));
  a.Field("width_m", c.width_m, "How far it sinks in from one to the other",
          Within(Contact::kWidth));
}

template <class Archive>
void Describe(Archive& a, sim::TerrainConfig& t) {
  using Kind = sim::TerrainKind;
  using Terrain = sim::TerrainConfig;
  a.Kind("kind", t.kind, Choices<Kind>(), "The form of the ground");
  a.Field("friction", t.friction, "Friction coefficient of tyres and feet",
          Within(Terrain::kFriction));
  a.Field("rolling_resistance", t.rolling_resistance,
          "Rolling resistance coefficient (0.015 hard ground, 0.05 grass)",
          Within(Terrain::kRollingResistance));
  a.Field("half_size_m", t.half_size_m,
          "The map is the square |x|, |y| <= half_size_m; leaving it ends the run",
          Within(t.kind == Kind::kRough    ? Terrain::kRoughHalfSize
                 : t.kind == Kind::kGravel ? Terrain::kGravelHalfSize
                                           : Terrain::kHalfSize));
  if (t.kind == Kind::kSlope) {
    a.Field("angle_deg", t.angle_deg, "Inclination", Within(Terrain::kAngle));
    a.Field("uphill_deg", t.uphill_deg, "Direction of ascent, from +x towards +y",
            Within(Terrain::kUphill));
  }
  if (t.kind == Kind::kRough) {
    a.Field("rms_m", t.rms_m, "Standard deviation of the height", Within(Terrain::kRms));
    a.Field("shortest_wave_m", t.shortest_wave_m, "Shortest wavelength", Within(Terrain::kWave));
    a.Field("longest_wave_m", t.longest_wave_m, "Longest wavelength", Within(Terrain::kWave));
  }
  if (t.kind == Kind::kKerbs) {
    a.Field("kerb_height_m", t.kerb_height_m, "Height of a kerb", Within(Terrain::kKerbHeight));
    a.Field("kerb_width_m", t.kerb_width_m, "Width of a kerb along x", Within(Terrain::kKerbWidth));
    a.Field("kerb_spacing_m", t.kerb_spacing_m, "Distance from kerb to kerb along x",
            Within(Terrain::kKerbSpacing));
  }
  if (t.kind == Kind::kStairs) {
    a.Field("step_height_m", t.step_height_m, "Height of a step", Within(Terrain::kStepHeight));
    a.Field("step_depth_m", t.step_depth_m, "Depth of a tread", Within(Terrain::kStepDepth));
    a.Field("steps", t.steps, "Steps of a flight", Within(Terrain::kSteps));
  }
  if (t.kind == Kind::kDebris) {
    a.Field("piece_height_m", t.piece_height_m, "Of the highest piece",
            Within(Terrain::kPieceHeight));
    a.Field("pieces_per_m2", t.pieces_per_m2, "How many lie about", Within(Terrain::kPieces));
  }
  if (t.kind == Kind::kGravel) {
    a.Field("stone_m", t.stone_m, "Across a stone", Within(Terrain::kStone));
    a.Field("stone_height_m", t.stone_height_m, "How much higher one can lie than another",
            Within(Terrain::kStoneHeight));
  }
  a.Field("contact", t.contact, "How the ground gives way under feet");
}

template <class Archive>
void Describe(Archive& a, sim::PatchConfig& p) {
  a.Field("box_m", p.box_m, "Centre x, centre y, size along x, size along y",
          Within(sim::PatchConfig::kBox), Need::kHere);
  a.Field("friction", p.friction, "Friction coefficient inside",
          Within(sim::TerrainConfig::kFriction));
}

}  // namespace reckon::harness
