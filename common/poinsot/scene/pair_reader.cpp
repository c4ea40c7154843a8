#include "poinsot/scene/pair_reader.h"

#include "poinsot/scene/entry_reader.h"

namespace poinsot {

PairDef read_pair(const YamlNode& node, const std::string& path, bool names_known,
                  FaultList& faults, YamlReader& reader) {
  PairDef pair;
  pair.where = faults.where(node);
  EntryReader entry(node, "a pair", path, kPairKeyTable, faults, reader);
  if (!entry.is_table()) {
    for (const char* key : {".a", ".b"}) faults.distrust(path + key);
    return pair;
  }
  for (const char* key : {"a", "b"}) entry.required(key);
  entry.name("a", pair.a, names_known);
  entry.name("b", pair.b, names_known);
  entry.number("friction", pair.friction);
  entry.number("restitution", pair.restitution);
  entry.boolean("collide", pair.collide);

  const bool says_something =
      entry.has("friction") || entry.has("restitution") || entry.has("collide");
  if (!says_something && !faults.distrusted(path))
    entry.refuse("", "a pair needs the key 'friction', 'restitution' or 'collide'");
  return pair;
}

}  // namespace poinsot
