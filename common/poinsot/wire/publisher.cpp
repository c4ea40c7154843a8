#include "poinsot/wire/publisher.h"

#include <fastdds/dds/publisher/DataWriter.hpp>

#include "poinsot/base/error.h"
#include "poinsot/wire/convert.h"
#include "poinsot/wire/message_types.h"
#include "poinsot/wire/participant_impl.h"
#include "poinsot/wire/qos.h"

namespace poinsot {

namespace dds = eprosima::fastdds::dds;

template <class Message>
struct Publisher<Message>::Impl {
  using Support = typename MessageType<Message>::Support;

  Impl(std::shared_ptr<BusCore> bus, std::string_view world, std::string_view suffix)
      : core(std::move(bus)), is_one_of_many(!suffix.empty()) {
    const std::string name = checked_topic_name(world, kTopicName<Message>, suffix);
    topic = core->topic(name, dds::TypeSupport(new Support));
    dds::DataWriterQos qos = core->publisher()->get_default_datawriter_qos();
    set_writer_qos(topic_qos(kTopicName<Message>), qos);
    writer = core->publisher()->create_datawriter(topic, qos);
    if (writer == nullptr) throw Error("topic " + name + ": cannot be written");
  }
  ~Impl() {
    if (writer != nullptr) core->publisher()->delete_datawriter(writer);
    if (is_one_of_many) core->forget(topic);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::shared_ptr<BusCore> core;
  dds::Topic* topic = nullptr;
  bool is_one_of_many = false;  // topics with a suffix come and go
  dds::DataWriter* writer = nullptr;
  typename Support::type sample;  // reused
};

template <class Message>
Publisher<Message>::Publisher(Participant& participant, std::string_view world,
                              std::string_view suffix)
    : impl_(std::make_unique<Impl>(participant.impl().core, world, suffix)) {}
template <class Message>
Publisher<Message>::~Publisher() = default;
template <class Message>
Publisher<Message>::Publisher(Publisher&&) noexcept = default;
template <class Message>
Publisher<Message>& Publisher<Message>::operator=(Publisher&&) noexcept = default;

template <class Message>
bool Publisher<Message>::write(const Message& message) {
  if (!to_message(message, impl_->sample).empty()) return false;
  return impl_->writer->write(&impl_->sample);
}

template <class Message>
bool Publisher<Message>::forget(const Message& message) {
  to_message(message, impl_->sample);  // of which only the key counts
  return impl_->writer->unregister_instance(&impl_->sample, dds::InstanceHandle_t()) ==
         eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
}

template <class Message>
int Publisher<Message>::readers() const {
  dds::PublicationMatchedStatus status;
  impl_->writer->get_publication_matched_status(status);
  return status.current_count;
}

template class Publisher<PoseSnapshot>;
template class Publisher<BodyInfo>;
template class Publisher<RunReport>;
template class Publisher<WrenchCommand>;
template class Publisher<RunControl>;
template class Publisher<Reply>;
template class Publisher<ImpactNotice>;
template class Publisher<ContactSnapshot>;
template class Publisher<HeldList>;

}  // namespace poinsot
