#include "poinsot/scene/validate_pairs.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "poinsot/base/limits.h"
#include "poinsot/scene/body_names.h"
#include "poinsot/scene/fault_text.h"

namespace poinsot {
namespace {

class PairValidation {
 public:
  explicit PairValidation(const Scene& scene) : scene_(scene), bodies_(scene) {
    for (const BodyDef& body : scene.bodies)
      bodies_went_ = bodies_went_ || body.absent || body.generation > 1;
  }

  std::vector<SceneFault> run() {
    if (scene_.pairs.size() > kMaxPairs)
      faults_.push_back({"",
                         "a scene has at most " + std::to_string(kMaxPairs) + " pairs, this one " +
                             std::to_string(scene_.pairs.size()),
                         "pairs"});
    for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
      path_ = "pairs[" + std::to_string(i) + "]";
      check(scene_.pairs[i]);
    }
    return std::move(faults_);
  }

 private:
  void check(const PairDef& pair) {
    const auto add = [&](std::string_view key, std::string what) {
      faults_.push_back(
          {pair.where, std::move(what), key.empty() ? path_ : path_ + "." + std::string(key)});
    };
    if (pair.friction && !(*pair.friction >= 0 && *pair.friction <= kMagnitude))
      add("friction", "friction must be >= 0 and finite, is " + digits(*pair.friction));
    if (pair.restitution && !(*pair.restitution >= 0 && *pair.restitution <= 1))
      add("restitution", "restitution must be 0 to 1, is " + digits(*pair.restitution));
    if (!pair.collide && (pair.friction || pair.restitution))
      add("collide", "a pair that does not collide has no friction and no restitution");

    const BodyDef* a = bodies_.find(pair.a);
    const BodyDef* b = bodies_.find(pair.b);
    if (!a && !bodies_went_) add("a", bodies_.unknown(pair.a));
    if (!b && !bodies_went_) add("b", bodies_.unknown(pair.b));
    if (!a || !b) return;
    if (a == b) return add("b", "a pair must name two bodies, both are " + in_quotes(pair.a));
    const auto [first, is_new] = firsts_.emplace(std::minmax(a, b), std::pair(&pair, path_));
    if (is_new) return;
    const auto& [other, path] = first->second;
    add("", "duplicate pair of " + in_quotes(pair.a) + " and " + in_quotes(pair.b) + ", first at " +
                (other->where.empty() ? path : other->where));
  }

  const Scene& scene_;
  BodyNames bodies_;
  bool bodies_went_ = false;  // in a run: their names may still be in pairs, should they come back
  std::string path_;          // of the pair that is looked at
  std::map<std::pair<const BodyDef*, const BodyDef*>, std::pair<const PairDef*, std::string>>
      firsts_;
  std::vector<SceneFault> faults_;
};

}  // namespace

std::vector<SceneFault> validate_pairs(const Scene& scene) {
  return PairValidation(scene).run();
}

}  // namespace poinsot
