// Speed against error of a scene, as plain data: what was tried, what came out.
//
// Errors are the largest over the compared frames and the bodies that move, up to the horizon;
// costs are CPU seconds of this machine per simulated second. README.md defines each.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

// One way to run the scene: what it changes, and how it is called. Settings of one family differ in
// one number and make one curve.
struct Setting {
  std::string family;          // the integrator's name
  std::string label;           // "1/240 s", "1e-08", "default"
  bool of_the_scene = false;   // the scene asks for just this
  SimulationDef simulation{};  // in the place of the scene's

  std::string name() const { return family + " " + label; }
};

// How far bodies are from where they should be.
struct PoseError {
  double position = 0;     // [m] of the body frame's origin
  double orientation = 0;  // [rad] angle of the rotation between the two

  // The one number that is compared: metres and radians alike.
  double larger() const { return position > orientation ? position : orientation; }
  bool operator==(const PoseError&) const = default;
};
PoseError largest(const PoseError& a, const PoseError& b);  // of each

// CPU time per simulated second [-], each without the layers beneath.
struct Cost {
  double simulation = 0;
  double collision = 0;
  double contact = 0;
};

struct Row {
  Setting setting;
  PoseError measured;              // against the reference
  double energy_error = 0;         // [-] relative, largest
  double momentum_error = 0;       // [-] relative, largest
  Cost cost;                       // of the run with the median cost of simulation
  std::uint32_t runs = 0;          // that the median is of
  std::uint32_t quarantined = 0;   // bodies frozen because the setting failed on them
  std::vector<Method> methods;     // that moved a body
  std::vector<std::string> equal;  // labels of settings with the same states, bit for bit
  bool pareto = false;             // see pareto.h
};

// One impact search, with the scene's integrator.
struct SearchRow {
  ImpactSearchKind search = ImpactSearchKind::conservative;
  bool of_the_scene = false;
  PoseError difference;     // from the run with `conservative`, largest up to the horizon
  double energy_error = 0;  // [-] relative, largest
  Cost cost;                // of the run with the median cost of simulation
  std::uint32_t runs = 0;   // that the median is of
  // Per simulated second.
  double impacts = 0;   // located
  double searches = 0;  // of a pair
  double poses = 0;     // evaluations of a pair's poses that they took
  double gaps = 0;      // queries of the narrow phase
};

enum class HorizonEnd {
  asked,         // the reference exists as far as was asked for
  disagreement,  // the runs part
  budget,        // there was no time for more
  interrupted,
};

// The run that errors are measured against, and those that vouch for it.
struct ReferenceInfo {
  std::string name;         // of the reference: "taylor default"
  std::string check;        // of the runs that it agrees with
  bool independent = true;  // one of them shares no method with it
  PoseError certificate;    // the largest difference up to the horizon
  PoseError limit;          // the difference that ends the horizon
  HorizonEnd end = HorizonEnd::asked;
};

struct StudyResult {
  std::string scene;
  std::uint32_t bodies = 0;   // that move
  double frame_rate = 60;     // [Hz]
  std::uint64_t asked = 0;    // frames
  std::uint64_t horizon = 0;  // frames up to which errors are measured; 0: there is no reference
  std::uint64_t stride = 1;   // every so many frames are compared
  ReferenceInfo reference;
  std::vector<Row> rows = {};            // in the order of the families
  std::vector<Setting> skipped = {};     // the budget did not allow them; likewise
  std::vector<SearchRow> searches = {};  // empty if nothing meets
  bool interrupted = false;              // not all was tried
  double horizon_time() const { return static_cast<double>(horizon) / frame_rate; }  // [s]
};

// The error that a row is good for: nothing below the certificate is known.
PoseError known_error(const Row& row, const ReferenceInfo& reference);

}  // namespace poinsot
