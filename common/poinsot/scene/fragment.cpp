#include "poinsot/scene/fragment.h"

#include <string>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/scene/body_reader.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {
namespace {

constexpr const char* kName = "spawn";
// Values of all bodies, aliases counted: the text itself holds no more than half as many. Aliases
// are there to share a shape, not to make a flood of a few bytes.
constexpr std::size_t kMaxFragmentValues = 65536;

}  // namespace

std::vector<BodyDef> parse_fragment(std::string_view text) {
  if (text.size() > kMaxFragmentText)
    throw Error(std::string(kName) + ": a fragment must not be longer than " +
                std::to_string(kMaxFragmentText) + " bytes, has " + std::to_string(text.size()));
  const YamlTree tree = parse_yaml(text, kName);
  FaultList faults(kName);
  YamlReader reader(faults, {.values = kMaxFragmentValues, .files = false});
  Scene scene;  // of defaults, with these bodies
  scene.world = kName;
  if (const auto fields = reader.fields(*tree.root, "a fragment", kFragmentTable))
    if (const YamlNode* node = reader.required(*fields, *tree.root, "a fragment", "bodies"))
      if (const auto* items = reader.list(*node, "bodies")) {
        if (items->empty()) faults.add(*node, "bodies must not be empty");
        for (const YamlNode* item : *items)
          scene.bodies.push_back(read_body(
              *item, "bodies[" + std::to_string(scene.bodies.size()) + "]", faults, reader));
      }
  faults.add(validate(scene), *tree.root);
  if (const auto found = faults.sorted(); !found.empty()) throw_faults(found);
  return std::move(scene.bodies);
}

}  // namespace poinsot
