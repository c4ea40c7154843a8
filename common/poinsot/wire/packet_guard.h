// A transport before another one that lets no packet in which the library does not survive
// (packet_check.h). What goes out passes as it is.

#pragma once

#include <memory>

#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

namespace poinsot {

std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> transport);

}  // namespace poinsot
