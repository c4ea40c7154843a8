#include "poinsot/wire/subscriber.h"

#include <algorithm>

#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "poinsot/base/check.h"
#include "poinsot/base/error.h"
#include "poinsot/wire/convert.h"
#include "poinsot/wire/message_types.h"
#include "poinsot/wire/participant_impl.h"
#include "poinsot/wire/qos.h"

namespace poinsot {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

WriterKey key_of(const dds::InstanceHandle_t& handle) {
  WriterKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = handle.value[i];
  return key;
}

// Tells of writers that are matched no longer.
struct WriterWatch : dds::DataReaderListener {
  explicit WriterWatch(std::function<void(const WriterKey&)> on_lost) : lost(std::move(on_lost)) {}
  void on_subscription_matched(dds::DataReader*,
                               const dds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change < 0) lost(key_of(status.last_publication_handle));
  }
  std::function<void(const WriterKey&)> lost;
};

}  // namespace

template <class Message>
struct Subscriber<Message>::Impl {
  using Support = typename MessageType<Message>::Support;

  Impl(std::shared_ptr<BusCore> bus, std::string_view world, std::string_view suffix,
       WriterLost on_lost)
      : core(std::move(bus)), watch(std::move(on_lost)) {
    const std::string name = checked_topic_name(world, kTopicName<Message>, suffix);
    dds::Topic* topic = core->topic(name, dds::TypeSupport(new Support));
    dds::DataReaderQos qos = core->subscriber()->get_default_datareader_qos();
    set_reader_qos(topic_qos(kTopicName<Message>), qos);
    reader = watch.lost ? core->subscriber()->create_datareader(
                              topic, qos, &watch, dds::StatusMask::subscription_matched())
                        : core->subscriber()->create_datareader(topic, qos);
    if (reader == nullptr) throw Error("topic " + name + ": cannot be read");
    reader->get_statuscondition().set_enabled_statuses(dds::StatusMask::data_available());
  }
  ~Impl() {
    if (reader == nullptr) return;
    reader->set_listener(nullptr);
    core->subscriber()->delete_datareader(reader);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::shared_ptr<BusCore> core;
  WriterWatch watch;
  dds::DataReader* reader = nullptr;
  WriterKey writer{};
  typename Support::type sample;  // reused
};

namespace {

template <class Type>
Malformed malformed(const Type& sample, std::string reason) {
  Malformed result{.reason = std::move(reason)};
  if constexpr (requires { sample.client(); }) {
    result.client = sample.client();
    result.seq = sample.seq();
  }
  return result;
}

}  // namespace

template <class Message>
Subscriber<Message>::Subscriber(Participant& participant, std::string_view world,
                                std::string_view suffix, WriterLost lost)
    : impl_(std::make_unique<Impl>(participant.impl().core, world, suffix, std::move(lost))) {}
template <class Message>
Subscriber<Message>::~Subscriber() = default;
template <class Message>
Subscriber<Message>::Subscriber(Subscriber&&) noexcept = default;
template <class Message>
Subscriber<Message>& Subscriber<Message>::operator=(Subscriber&&) noexcept = default;

template <class Message>
bool Subscriber<Message>::take(Message& message,
                               const std::function<void(const Malformed&)>& refused) {
  dds::SampleInfo info;
  while (impl_->reader->take_next_sample(&impl_->sample, &info) == ReturnCode_t::RETCODE_OK) {
    impl_->writer = key_of(info.publication_handle);
    if (!info.valid_data) continue;  // a writer left, or an instance was taken back
    std::string reason = from_message(impl_->sample, message);
    if (reason.empty()) return true;
    if (refused) refused(malformed(impl_->sample, std::move(reason)));
  }
  return false;
}

template <class Message>
const WriterKey& Subscriber<Message>::writer() const {
  return impl_->writer;
}

template <class Message>
int Subscriber<Message>::writers() const {
  dds::SubscriptionMatchedStatus status;
  impl_->reader->get_subscription_matched_status(status);
  return status.current_count;
}

struct Waiter::Impl {
  dds::WaitSet set;
  dds::GuardCondition woken;
  std::vector<dds::DataReader*> readers;
};

Waiter::Waiter() : impl_(std::make_unique<Impl>()) {
  impl_->set.attach_condition(impl_->woken);
}
Waiter::~Waiter() = default;

template <class Message>
void Waiter::attach(Subscriber<Message>& subscriber) {
  dds::DataReader* reader = subscriber.impl().reader;
  POINSOT_CHECK(impl_->set.attach_condition(reader->get_statuscondition()) ==
                ReturnCode_t::RETCODE_OK);
  impl_->readers.push_back(reader);
}

bool Waiter::wait(std::chrono::nanoseconds timeout) {
  // The status condition falls when one sample is taken, though others may remain.
  const auto has_data = [](dds::DataReader* reader) { return reader->get_unread_count() > 0; };
  if (!impl_->woken.get_trigger_value() &&
      std::any_of(impl_->readers.begin(), impl_->readers.end(), has_data))
    return true;
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t ns = std::clamp<std::int64_t>(timeout.count(), 0, kSecond * 1'000'000);
  dds::ConditionSeq active;
  impl_->set.wait(
      active, {static_cast<std::int32_t>(ns / kSecond), static_cast<std::uint32_t>(ns % kSecond)});
  const bool was_woken = impl_->woken.get_trigger_value();
  impl_->woken.set_trigger_value(false);
  return std::any_of(active.begin(), active.end(),
                     [&](const dds::Condition* condition) { return condition != &impl_->woken; }) ||
         was_woken;
}

void Waiter::wake() {
  impl_->woken.set_trigger_value(true);
}

template class Subscriber<PoseSnapshot>;
template class Subscriber<BodyInfo>;
template class Subscriber<RunReport>;
template class Subscriber<WrenchCommand>;
template class Subscriber<RunControl>;
template class Subscriber<Reply>;
template class Subscriber<ImpactNotice>;
template class Subscriber<ContactSnapshot>;
template class Subscriber<HeldList>;
template void Waiter::attach(Subscriber<PoseSnapshot>&);
template void Waiter::attach(Subscriber<BodyInfo>&);
template void Waiter::attach(Subscriber<RunReport>&);
template void Waiter::attach(Subscriber<WrenchCommand>&);
template void Waiter::attach(Subscriber<RunControl>&);
template void Waiter::attach(Subscriber<Reply>&);
template void Waiter::attach(Subscriber<ImpactNotice>&);
template void Waiter::attach(Subscriber<ContactSnapshot>&);
template void Waiter::attach(Subscriber<HeldList>&);

}  // namespace poinsot
