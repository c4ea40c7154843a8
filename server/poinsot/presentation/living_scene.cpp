#include "poinsot/presentation/living_scene.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "poinsot/base/check.h"
#include "poinsot/base/hash.h"
#include "poinsot/scene/scene_archive.h"

namespace poinsot {
namespace {

std::uint64_t digest_of(BodyDef body, std::uint64_t before, std::size_t place) {
  body.where.clear();
  ByteWriter out;
  out(body);
  Hash64 hash;
  hash.add(before);
  hash.add(std::uint64_t{place});
  for (const std::byte byte : out.bytes()) hash.add(static_cast<std::uint64_t>(byte));
  return hash.value() | 1;
}

// A spring without a rest length has its length at time 0: it must keep it when bodies get other
// poses at time 0. The same operations as where the springs are made.
void fix_rest_lengths(Scene& scene) {
  std::map<std::string_view, const BodyDef*> bodies;
  for (const BodyDef& body : scene.bodies)
    if (!body.absent) bodies.emplace(body.name, &body);
  const auto in_W = [&](const std::string& name, const Vec3& point) -> Vec3 {
    const BodyDef& body = *bodies.at(name);
    const Vec3& center = body.mass_properties.center_of_mass;
    return Pose{body.pose * center - body.pose.q * center, body.pose.q} * point;
  };
  for (SpringDef& def : scene.springs)
    if (!def.rest_length) {
      const Vec3 at_b = def.b.empty() ? def.point_b : in_W(def.b, def.point_b);
      def.rest_length = (in_W(def.a, def.point_a) - at_b).norm();
    }
}

}  // namespace

LivingScene::LivingScene(Scene scene)
    : original_(std::make_shared<const Scene>(std::move(scene))), scene_(original_) {
  find_absent();
}

void LivingScene::find_absent() {
  absent_.clear();
  for (std::size_t i = 0; i < now().bodies.size(); ++i)
    if (now().bodies[i].absent) absent_.insert(i);
}

std::shared_ptr<const Scene> LivingScene::share() const {
  is_shared_ = true;
  return scene_;
}

Scene& LivingScene::change() {
  if (is_shared_) scene_ = std::make_shared<Scene>(*scene_);
  is_shared_ = false;
  return const_cast<Scene&>(*scene_);  // made above, and nobody else has it
}

bool LivingScene::is_original(std::size_t place) const {
  const auto& before = original().bodies;
  const BodyDef& body = now().bodies[place];
  return place < before.size() && !before[place].absent && !body.absent &&
         body.generation == before[place].generation;
}

std::size_t LivingScene::add(BodyDef& body) {
  Scene& scene = change();
  const std::size_t place = absent_.empty() ? scene.bodies.size() : *absent_.begin();
  body.absent = false;
  if (absent_.empty()) {
    body.generation = 1;
    scene.bodies.push_back(body);
  } else {
    body.generation = scene.bodies[place].generation + 1;
    scene.bodies[place] = body;
    absent_.erase(absent_.begin());
  }
  digest_ = digest_of(body, digest_, place);
  ++revision_;
  return place;
}

void LivingScene::remove(std::size_t place) {
  Scene& scene = change();
  BodyDef gone;
  gone.absent = gone.is_static = true;
  gone.generation = scene.bodies[place].generation;
  const std::string name = std::exchange(scene.bodies[place], gone).name;
  absent_.insert(place);
  std::erase_if(scene.springs, [&](const SpringDef& d) { return d.a == name || d.b == name; });
  std::erase_if(scene.wrenches, [&](const WrenchDef& d) { return d.body == name; });
  digest_ = digest_of(gone, digest_, place);
  ++revision_;
}

void LivingScene::set_start(std::size_t place, const Pose& pose, const Vec3& linear_velocity,
                            const Vec3& angular_velocity) {
  Scene& scene = change();
  if (!rests_are_fixed_) fix_rest_lengths(scene);
  rests_are_fixed_ = true;
  BodyDef& body = scene.bodies[place];
  body.pose = pose;
  body.linear_velocity = linear_velocity;
  body.angular_velocity = angular_velocity;
}

void LivingScene::move_static(std::size_t place, const Pose& pose) {
  set_start(place, pose, Vec3::Zero(), Vec3::Zero());
  ++revision_;
}

void LivingScene::start_afresh() {
  if (scene_ != original_) become(original_, 0);
}

void LivingScene::become(std::shared_ptr<const Scene> scene, std::uint64_t digest) {
  if (scene != scene_) ++revision_;
  scene_ = std::move(scene);
  is_shared_ = true;
  rests_are_fixed_ = false;
  digest_ = digest;
  find_absent();
}

// As a text, which an archive takes as one piece.
const std::string& LivingScene::original_bytes() const {
  if (!original_bytes_) {
    ByteWriter out;
    out(*original_);
    const auto* const first = reinterpret_cast<const char*>(out.bytes().data());
    original_bytes_ = std::make_shared<const std::string>(first, out.bytes().size());
  }
  return *original_bytes_;
}

void LivingScene::save(ByteWriter& out) const {
  const bool differs = scene_ != original_;
  out(digest_, differs);
  if (differs) out(original_bytes());
}

void LivingScene::restore(ByteReader& in, std::shared_ptr<const Scene> scene) {
  POINSOT_CHECK(scene != nullptr);
  std::uint64_t digest = 0;
  bool differs = false;
  in(digest, differs);
  if (differs) {
    std::string bytes;
    in(bytes);
    if (bytes != original_bytes()) {
      Scene original;
      ByteReader of_original(std::as_bytes(std::span(bytes)));
      of_original(original);
      original_ = std::make_shared<const Scene>(std::move(original));
      original_bytes_ = std::make_shared<const std::string>(std::move(bytes));
    }
  } else if (original_ != scene) {
    original_ = scene;
    original_bytes_ = nullptr;
  }
  become(std::move(scene), digest);
}

}  // namespace poinsot
