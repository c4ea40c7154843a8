#include "poinsot/wire/packet_guard.h"

#include <chrono>
#include <utility>

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include "poinsot/wire/packet_check.h"

namespace poinsot {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::LocatorsIterator;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::SenderResource;
using Locator = eprosima::fastrtps::rtps::Locator_t;

class Guard : public rtps::ChainingTransport {
 public:
  Guard(const rtps::ChainingTransportDescriptor& descriptor, std::uint32_t largest)
      : ChainingTransport(descriptor), largest_(largest) {}

  rtps::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }
  bool send(SenderResource* out, const octet* bytes, std::uint32_t size, LocatorsIterator* begin,
            LocatorsIterator* end, const std::chrono::steady_clock::time_point& until) override {
    return out->send(bytes, size, begin, end, until);
  }
  void receive(rtps::TransportReceiverInterface* next, const octet* bytes, std::uint32_t size,
               const Locator& local, const Locator& remote) override {
    if (is_harmless({bytes, size}, largest_)) next->OnDataReceived(bytes, size, local, remote);
  }

 private:
  std::uint32_t largest_;
};

class GuardDescriptor : public rtps::ChainingTransportDescriptor {
 public:
  GuardDescriptor(std::shared_ptr<rtps::TransportDescriptorInterface> transport,
                  std::uint32_t largest)
      : ChainingTransportDescriptor(std::move(transport)), largest_(largest) {}

  rtps::TransportInterface* create_transport() const override { return new Guard(*this, largest_); }

 private:
  std::uint32_t largest_;
};

}  // namespace

std::shared_ptr<rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<rtps::TransportDescriptorInterface> transport, std::uint32_t largest) {
  return std::make_shared<GuardDescriptor>(std::move(transport), largest);
}

}  // namespace poinsot
