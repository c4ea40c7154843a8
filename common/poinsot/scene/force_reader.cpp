#include "poinsot/scene/force_reader.h"

#include "poinsot/scene/entry_reader.h"

namespace poinsot {

SpringDef read_spring(const YamlNode& node, const std::string& path, bool names_known,
                      FaultList& faults, YamlReader& reader) {
  SpringDef spring;
  spring.where = faults.where(node);
  EntryReader entry(node, "a spring", path, kSpringTable, faults, reader);
  if (!entry.is_table()) {
    faults.distrust(path + ".a");
    return spring;
  }
  entry.required("a");
  entry.name("a", spring.a, names_known);
  entry.name("b", spring.b, names_known);
  entry.vector("point_a", spring.point_a);
  entry.vector("point_b", spring.point_b);
  entry.number("stiffness", spring.stiffness);
  entry.number("damping", spring.damping);
  entry.number("rest_length", spring.rest_length);
  return spring;
}

WrenchDef read_wrench(const YamlNode& node, const std::string& path, bool names_known,
                      FaultList& faults, YamlReader& reader) {
  WrenchDef wrench;
  wrench.where = faults.where(node);
  EntryReader entry(node, "a wrench", path, kWrenchTable, faults, reader);
  if (!entry.is_table()) {
    faults.distrust(path + ".body");
    return wrench;
  }
  entry.required("body");
  entry.name("body", wrench.body, names_known);
  entry.vector("force", wrench.force);
  entry.vector("torque", wrench.torque);
  entry.word("frame", kAxesNames, wrench.axes);
  entry.vector("point", wrench.point);
  if (entry.has("point")) wrench.point_frame = PointFrame::body;
  entry.word("point_frame", kPointFrameNames, wrench.point_frame);
  entry.number("start", wrench.start);
  entry.number("duration", wrench.duration);

  if (!entry.has("force") && !entry.has("torque") && !faults.distrusted(path))
    entry.refuse("", "a wrench needs the key 'force' or 'torque'");
  const bool at_center = wrench.point_frame == PointFrame::center_of_mass;
  if (entry.has("point") && at_center)
    entry.refuse("point", "a point has the point_frame world or body");
  if (!entry.has("point") && !at_center)
    entry.refuse("point_frame", "point_frame needs the key 'point'");
  return wrench;
}

}  // namespace poinsot
