// A transport before another one that lets no packet in which the library does not survive
// (packet_check.h). What goes out passes as it is.
//
// `largest` [bytes]: of the samples that come in.

#pragma once

#include <cstdint>
#include <memory>

#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

namespace poinsot {

std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> transport,
    std::uint32_t largest);

}  // namespace poinsot
