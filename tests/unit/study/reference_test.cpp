#include "poinsot/study/reference.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/scene_builder.h"
#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kFrames = 120;

// A tumbling body, once with one sub-step per frame so that `step` alone sets the error.
Scene tumbling() {
  BodyDef body = test::free_body("body", 2, Vec3(1, 2, 3));
  body.angular_velocity = Vec3(1, 3, 2);
  Scene scene = test::scene({body});
  scene.collision.contact_step = 1;
  return scene;
}

ReferenceOptions options(double limit = 1) {
  return {.frames = kFrames,
          .limit = {limit, limit},
          .deadline = Clock::now() + std::chrono::minutes(10)};
}

Reference reference(const std::vector<Setting>& candidates, const ReferenceOptions& o) {
  return make_reference(tumbling(), candidates, o, {});
}

const std::vector<Setting>& two() {
  static const std::vector<Setting> settings = {test::setting(rk4, 1. / 480),
                                                test::setting(rk4, 1. / 120)};
  return settings;
}

TEST(Reference, GoesAsFarAsAskedForWhereItsMethodsAgree) {
  const Reference r = reference(two(), options());
  EXPECT_EQ(r.frames, kFrames);
  EXPECT_EQ(r.info.end, HorizonEnd::asked);
  EXPECT_EQ(r.path.size(), kFrames + 1);
  EXPECT_EQ(r.info.name, "rk4 1/480 s");
  EXPECT_EQ(r.info.check, "rk4 1/120 s");
}

TEST(Reference, IsCertifiedByALargestDifferenceThatOnlyGrows) {
  const Reference r = reference(two(), options());
  ASSERT_EQ(r.certificate.size(), kFrames + 1);
  EXPECT_EQ(r.certificate.front(), PoseError{});
  for (std::size_t k = 1; k <= kFrames; ++k)
    EXPECT_GE(r.certificate[k].orientation, r.certificate[k - 1].orientation);
  EXPECT_GT(r.certificate.back().orientation, 0);
  EXPECT_EQ(r.info.certificate, r.certificate.back());
}

// Halving the step of a method of order four divides its error by sixteen: two runs that are nearer
// to the truth agree better.
TEST(Reference, IsCertifiedBetterByBetterMethods) {
  const double coarse = reference(two(), options()).info.certificate.orientation;
  const double fine =
      reference({test::setting(rk4, 1. / 960), test::setting(rk4, 1. / 240)}, options())
          .info.certificate.orientation;
  EXPECT_NEAR(coarse / fine, 16, 4);
}

TEST(Reference, EndsBeforeTheFrameAtWhichTheMethodsPart) {
  const Reference whole = reference(two(), options());
  const double limit = whole.certificate[50].orientation;
  const Reference r = reference(two(), options(limit));
  EXPECT_EQ(r.info.end, HorizonEnd::disagreement);
  EXPECT_GE(r.frames, 50u);
  EXPECT_LT(r.frames, kFrames);
  EXPECT_EQ(r.path.size(), r.frames + 1);
  EXPECT_LE(r.info.certificate.orientation, limit);
  EXPECT_GT(whole.certificate[r.frames + 1].orientation, limit);
}

TEST(Reference, DoesNotExistWhereTheMethodsPartAtOnce) {
  const Reference r = reference(
      {test::setting(rk4, 1. / 480), test::setting(semi_implicit_euler, 1. / 60)}, options(1e-12));
  EXPECT_EQ(r.frames, 0u);
  EXPECT_EQ(r.info.end, HorizonEnd::disagreement);
  EXPECT_EQ(r.info.certificate, PoseError{});
}

// Where all are in steps the one in the middle is the reference, and the farthest limits what is
// known.
TEST(Reference, InStepsIsInTheMiddleAndAllMustAgree) {
  const Setting far = test::setting(rk4, 1. / 60), middle = test::setting(rk4, 1. / 120),
                near = test::setting(rk4, 1. / 960);
  const Reference r = reference({far, middle, near}, options(10));
  EXPECT_EQ(r.info.name, "rk4 1/120 s") << "its error is 1/16 of that of 1/60 s";
  EXPECT_EQ(r.info.check, "rk4 1/60 s and rk4 1/960 s");
  EXPECT_EQ(r.info.certificate.orientation,
            reference({middle, far}, options(10)).info.certificate.orientation);
}

// A body without a wrench flies; then the best of the others certifies.
TEST(Reference, InClosedFormIsCertifiedByTheBestOfTheOthers) {
  const Setting coarse = test::setting(rk4, 1. / 60), fine = test::setting(rk4, 1. / 960);
  const Reference r = reference({coarse, test::setting(exact, 0), fine}, options());
  EXPECT_EQ(r.info.name, "exact default");
  EXPECT_EQ(r.info.check, "rk4 1/960 s");
  EXPECT_TRUE(r.info.independent);
}

TEST(Reference, KeepsFewerFramesWhereThereAreMany) {
  ReferenceOptions few = options();
  few.frames = 25;
  few.max_poses = 7;
  const Reference r = reference(two(), few), all = reference(two(), options());
  EXPECT_EQ(r.stride, 4u);
  EXPECT_EQ(r.frames, 25u);
  ASSERT_EQ(r.path.size(), 8u);  // frames 0, 4 … 24, 25
  ASSERT_EQ(r.certificate.size(), 8u);
  EXPECT_EQ(r.certificate[6], all.certificate[24]);
  EXPECT_EQ(r.info.certificate, all.certificate[25]);
}

TEST(Reference, EndsWithItsTimeOrWhenStopped) {
  ReferenceOptions late = options();
  late.deadline = Clock::now();
  const Reference r = reference(two(), late);
  EXPECT_EQ(r.info.end, HorizonEnd::budget);
  EXPECT_GE(r.frames, 1u) << "one frame must be there to go on with";
  EXPECT_LT(r.frames, kFrames);

  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(make_reference(tumbling(), two(), options(), stop.get_token()).info.end,
            HorizonEnd::interrupted);
}

TEST(Reference, OfAFrozenBodyIsNone) {
  BodyDef body = test::free_body("body", 1, Vec3(1, 1, 1));
  body.linear_velocity = Vec3(1e200, 0, 0);  // absurd: the layer freezes it
  const Scene scene = test::scene({body});
  const Reference r = make_reference(scene, two(), options(), {});
  EXPECT_EQ(r.frames, 0u);
}

TEST(ReferenceSettings, AreThreeMethodsAtTheirTightest) {
  Scene scene = tumbling();
  scene.simulation.integrator = explicit_euler;
  scene.simulation.tolerance = 1e-3;
  std::vector<std::string> names;
  for (const Setting& setting : reference_settings(scene)) names.push_back(setting.name());
  EXPECT_EQ(names, (std::vector<std::string>{"exact default", "taylor default", "dop853 1e-13"}));
}

TEST(AgreementLimit, IsAMillionthOfARadianAndOfTheLargestBody) {
  Scene scene = test::scene({test::free_body("small", 1, Vec3(1e-6, 1e-6, 1e-6)),
                             test::free_body("large", 2, Vec3(12, 12, 12)), test::floor()});
  const double gyration = std::sqrt(36. / 4);  // √(tr J / 2m)
  EXPECT_NEAR(agreement_limit(scene, 0).position, 1e-6 * gyration, 1e-20);
  EXPECT_EQ(agreement_limit(scene, 0).orientation, 1e-6);
  EXPECT_NEAR(agreement_limit(scene, 1e-8).position, 1e-9, 1e-24);
  EXPECT_NEAR(agreement_limit(scene, 1e-8).orientation, 1e-9, 1e-24);
  EXPECT_EQ(agreement_limit(scene, 1).orientation, 1e-6);
}

}  // namespace
}  // namespace poinsot
