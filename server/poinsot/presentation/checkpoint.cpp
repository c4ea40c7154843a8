// PresentationLayer: checkpoints. The bytes are what is held, what the scene was at the start, then
// the collision layer's state; the scene, the frame and the hash stand beside them.

#include <utility>

#include "poinsot/base/archive.h"
#include "poinsot/base/error.h"
#include "poinsot/presentation/presentation_layer.h"

namespace poinsot {

std::shared_ptr<const Checkpoint> with_threads(const std::shared_ptr<const Checkpoint>& checkpoint,
                                               int threads) {
  if (threads == 0 || !checkpoint->scene || checkpoint->scene->collision.threads == threads)
    return checkpoint;
  auto scene = std::make_shared<Scene>(*checkpoint->scene);
  scene->collision.threads = threads;
  auto copy = std::make_shared<Checkpoint>(*checkpoint);
  copy->scene = std::move(scene);
  return copy;
}

std::shared_ptr<const Checkpoint> PresentationLayer::make_checkpoint(std::string name) const {
  const auto checkpoint = std::make_shared<Checkpoint>();
  checkpoint->name = std::move(name);
  checkpoint->epoch = epoch_;
  checkpoint->frame = frame_;
  BodyDigests digests;  // commands may have been accepted since the snapshot
  checkpoint->state_hash = state_hash(frame_, collision_, held_, scene_.digest(), digests);
  checkpoint->scene = scene_.share();
  ByteWriter out;
  held_.save(out);
  scene_.save(out);
  out(impacts_so_far_);
  collision_.save(out);
  checkpoint->state = out.take();
  return checkpoint;
}

void PresentationLayer::restore(const Checkpoint& checkpoint) {
  if (!checkpoint.scene) throw Error("checkpoint: it has no scene");
  ByteReader in(checkpoint.state);
  CollisionLayer collision(*checkpoint.scene);
  HeldWrenches held(checkpoint.scene->presentation.frame_rate, held_.revision() + 1);
  held.restore(in, std::as_const(collision).world().size());
  LivingScene scene = scene_;
  scene.restore(in, checkpoint.scene);
  std::uint64_t impacts = 0;
  in(impacts);
  collision.restore(in);
  if (in.left() > 0) ByteReader::fail();
  BodyDigests digests;
  if (state_hash(checkpoint.frame, collision, held, scene.digest(), digests) !=
      checkpoint.state_hash)
    throw Error("checkpoint: the state has another hash than when it was saved");

  // Nothing below fails.
  times_ = times();
  collision_ = std::move(collision);
  held_ = std::move(held);
  scene_ = std::move(scene);
  frame_ = checkpoint.frame;
  impacts_so_far_ = impacts;
  next_epoch();
}

}  // namespace poinsot
