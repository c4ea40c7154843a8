#include "poinsot/wire/participant.h"

#include <algorithm>
#include <mutex>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>

#include "poinsot/base/error.h"
#include "poinsot/base/limits.h"
#include "poinsot/wire/participant_impl.h"
#include "poinsot/wire/qos.h"
#include "poinsot/wire/topics.h"

namespace poinsot {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

class LogRelay : public dds::LogConsumer {
 public:
  explicit LogRelay(BusLog log) : log_(std::move(log)) {}

  void Consume(const dds::Log::Entry& entry) override {
    if (!log_ || entry.kind == dds::Log::Kind::Info) return;
    const auto level =
        entry.kind == dds::Log::Kind::Error ? BusLogLevel::error : BusLogLevel::warning;
    log_(level, std::string(entry.context.category) + ": " + entry.message);
  }

 private:
  BusLog log_;
};

// "poinsot/<world>/report" → world; empty for other topics.
std::string world_of(std::string_view topic) {
  constexpr std::string_view kPrefix = "poinsot/";
  constexpr std::string_view kSuffix = "/report";
  static_assert(kSuffix.substr(1) == kTopicName<RunReport>);
  if (topic.size() <= kPrefix.size() + kSuffix.size() || !topic.starts_with(kPrefix) ||
      !topic.ends_with(kSuffix))
    return {};
  topic.remove_prefix(kPrefix.size());
  topic.remove_suffix(kSuffix.size());
  return std::string(topic);
}

// A topic like poinsot/<world>/poses/<suffix>.
bool is_pose_stream(std::string_view topic) {
  constexpr std::string_view kPrefix = "poinsot/";
  static_assert(kTopicName<PoseSnapshot> == "poses");
  return topic.starts_with(kPrefix) && topic.find("/poses/", kPrefix.size()) != topic.npos;
}

// Endpoints meet if they name a partition in common, or none both.
template <class Info>
bool is_in(const std::string& partition, const Info& info) {
  const std::vector<std::string> names = info.m_qos.m_partition.names();
  if (names.empty() || partition.empty()) return names.empty() == partition.empty();
  return std::find(names.begin(), names.end(), partition) != names.end();
}

// Numbers that no participant of ours in this process has, ascending. A participant's UDP ports
// follow from its number, and only small numbers are greeted; Fast DDS would count a process's
// participants without end.
std::vector<int> free_numbers(const dds::DomainParticipantFactory& factory) {
  std::set<int> taken;
  for (int domain = 0; domain <= kMaxDomain; ++domain)
    for (const auto* other : factory.lookup_participants(static_cast<std::uint32_t>(domain)))
      taken.insert(other->get_qos().wire_protocol().participant_id);
  std::vector<int> numbers;
  for (int number = 0; number < kMaxLocalParticipants; ++number)
    if (!taken.contains(number)) numbers.push_back(number);
  return numbers;
}

}  // namespace

void route_bus_log(BusLog log) {
  dds::Log::ClearConsumers();
  dds::Log::RegisterConsumer(std::make_unique<LogRelay>(std::move(log)));
  dds::Log::SetVerbosity(dds::Log::Kind::Warning);
}

std::string checked_topic_name(std::string_view world, std::string_view topic,
                               std::string_view suffix) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (world.empty() || world.size() > kMaxNameLength ||
      !std::all_of(world.begin(), world.end(), allowed))
    throw Error("world '" + std::string(world) + "': a world's name has 1 to " +
                std::to_string(kMaxNameLength) + " letters, digits, '_' and '-'");
  const std::string name = topic_name(world, topic);
  return suffix.empty() ? name : name + "/" + std::string(suffix);
}

std::vector<std::string> WorldDirectory::worlds() const {
  std::set<std::string> names;
  const std::lock_guard lock(mutex_);
  for (const auto& [writer, world] : worlds_) names.insert(world);
  return {names.begin(), names.end()};
}

void WorldDirectory::on_publisher_discovery(dds::DomainParticipant* participant,
                                            rtps::WriterDiscoveryInfo&& info) {
  // The library tells of the participant's own writers, too.
  if (info.info.guid().guidPrefix == participant->guid().guidPrefix) return;
  const std::string world = world_of(info.info.topicName().c_str());
  if (world.empty() || !is_in(partition_, info.info)) return;
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER)
    worlds_.erase(info.info.guid());
  else
    worlds_[info.info.guid()] = world;
}

std::vector<std::string> WorldDirectory::pose_streams(std::string_view world) const {
  const std::string prefix = topic_name(world, kTopicName<PoseSnapshot>) + "/";
  std::set<std::string> suffixes;
  const std::lock_guard lock(mutex_);
  for (const auto& [reader, topic] : streams_)
    if (topic.starts_with(prefix)) suffixes.insert(topic.substr(prefix.size()));
  return {suffixes.begin(), suffixes.end()};
}

void WorldDirectory::on_subscriber_discovery(dds::DomainParticipant*,
                                             rtps::ReaderDiscoveryInfo&& info) {
  const std::string topic = info.info.topicName().c_str();
  if (!is_pose_stream(topic) || !is_in(partition_, info.info)) return;
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER)
    streams_.erase(info.info.guid());
  else
    streams_[info.info.guid()] = topic;
  ++stream_changes_;
}

void WorldDirectory::on_participant_discovery(dds::DomainParticipant*,
                                              rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  if (info.status != Info::REMOVED_PARTICIPANT && info.status != Info::DROPPED_PARTICIPANT) return;
  const std::lock_guard lock(mutex_);
  const auto is_gone = [&](const auto& entry) {
    return entry.first.guidPrefix == info.info.m_guid.guidPrefix;
  };
  std::erase_if(worlds_, is_gone);
  if (std::erase_if(streams_, is_gone) > 0) ++stream_changes_;
}

BusCore::BusCore(const BusOptions& options) : directory_(options.partition) {
  if (options.domain < 0 || options.domain > kMaxDomain)
    throw Error("domain " + std::to_string(options.domain) + " is not between 0 and " +
                std::to_string(kMaxDomain));
  auto* factory = dds::DomainParticipantFactory::get_instance();
  factory->load_profiles();  // FASTRTPS_DEFAULT_PROFILES_FILE becomes the default
  dds::DomainParticipantQos qos = factory->get_default_participant_qos();
  set_participant_qos(options, qos);
  // One thread at a time: a number is looked up, then taken. Another library of this process may
  // have taken it all the same.
  static std::mutex joining;
  const std::lock_guard lock(joining);
  constexpr std::size_t kAttempts = 4;
  const std::vector<int> numbers = free_numbers(*factory);
  for (std::size_t i = 0; i < std::min(kAttempts, numbers.size()) && participant_ == nullptr; ++i) {
    qos.wire_protocol().participant_id = numbers[i];
    participant_ = factory->create_participant(static_cast<std::uint32_t>(options.domain), qos,
                                               &directory_, dds::StatusMask::none());
  }
  if (participant_ != nullptr) {
    dds::PublisherQos of_publisher = participant_->get_default_publisher_qos();
    dds::SubscriberQos of_subscriber = participant_->get_default_subscriber_qos();
    if (!options.partition.empty()) {
      of_publisher.partition().push_back(options.partition.c_str());
      of_subscriber.partition().push_back(options.partition.c_str());
    }
    publisher_ = participant_->create_publisher(of_publisher);
    subscriber_ = participant_->create_subscriber(of_subscriber);
  }
  if (publisher_ == nullptr || subscriber_ == nullptr)
    throw Error("domain " + std::to_string(options.domain) + ": the bus cannot be joined");
}

BusCore::~BusCore() {
  if (participant_ == nullptr) return;
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* BusCore::topic(const std::string& name, dds::TypeSupport type) {
  const std::lock_guard lock(topics_mutex_);
  if (auto* known = dynamic_cast<dds::Topic*>(participant_->lookup_topicdescription(name)))
    return known;
  dds::Topic* topic = nullptr;
  if (type.register_type(participant_) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
    topic = participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) throw Error("topic " + name + ": cannot be made");
  return topic;
}

void BusCore::forget(dds::Topic* topic) {
  const std::lock_guard lock(topics_mutex_);
  participant_->delete_topic(topic);  // refused while another endpoint uses it
}

Participant::Participant(const BusOptions& options)
    : impl_(std::make_unique<Impl>(Impl{std::make_shared<BusCore>(options)})) {}
Participant::~Participant() = default;
Participant::Participant(Participant&&) noexcept = default;
Participant& Participant::operator=(Participant&&) noexcept = default;

std::vector<std::string> Participant::worlds() const {
  return impl_->core->directory().worlds();
}
std::vector<std::string> Participant::pose_streams(std::string_view world) const {
  return impl_->core->directory().pose_streams(world);
}
std::uint64_t Participant::pose_stream_changes() const {
  return impl_->core->directory().pose_stream_changes();
}

}  // namespace poinsot
