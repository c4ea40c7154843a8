// What a careless or hostile peer may send: nonsense in well-formed samples, and samples that are
// no message at all. Both are passed over; the stream goes on.

#include <limits>

#include <gtest/gtest.h>

#include "poinsot/wire/convert.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/protocol_samples.h"
#include "support/raw_type.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

namespace dds = eprosima::fastdds::dds;

TEST(Malformed, CommandsAreReportedWithTheirIdentityAndTheStreamGoesOn) {
  Participant here({.domain = test_domain()});
  Participant there({.domain = test_domain()});
  Subscriber<WrenchCommand> subscriber(here, "malformed");
  auto* writer = foreign_writer<WrenchCommand>(
      there, "malformed", dds::TypeSupport(new MessageType<WrenchCommand>::Support));
  ASSERT_NE(writer, nullptr);
  ASSERT_TRUE(eventually([&] { return subscriber.writers() == 1 && is_matched(writer); }));

  msg::v2::BodyWrench command;
  ASSERT_EQ(to_message(sample::wrench(), command), "");
  command.seq(7);
  command.force().x(std::numeric_limits<double>::quiet_NaN());
  ASSERT_TRUE(writer->write(&command));
  command.seq(8);
  command.force().x(1);
  ASSERT_TRUE(writer->write(&command));

  std::vector<Malformed> refused;
  WrenchCommand received;
  ASSERT_TRUE(eventually([&] {
    return subscriber.take(received, [&](const Malformed& m) { refused.push_back(m); });
  }));
  EXPECT_EQ(received.seq, 8u);
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].client, sample::wrench().client);
  EXPECT_EQ(refused[0].seq, 7u);
  EXPECT_EQ(refused[0].reason, "force.x is not finite");
}

TEST(Malformed, BytesThatAreNoMessageDoNotStopTheStream) {
  Participant here({.domain = test_domain()});
  Participant hostile({.domain = test_domain()});
  Participant honest({.domain = test_domain()});
  Subscriber<WrenchCommand> subscriber(here, "bytes");
  MessageType<WrenchCommand>::Support type;
  auto* writer = foreign_writer<WrenchCommand>(hostile, "bytes",
                                               dds::TypeSupport(new RawType(type.getName())));
  ASSERT_NE(writer, nullptr);
  Publisher<WrenchCommand> publisher(honest, "bytes");
  ASSERT_TRUE(eventually(
      [&] { return subscriber.writers() == 2 && publisher.readers() == 1 && is_matched(writer); }));

  // CDR little-endian header, then: nothing; a little; a string of 4 GB where the name is due.
  std::vector<unsigned char> truncated = {0, 1, 0, 0};
  std::vector<unsigned char> short_one = {0, 1, 0, 0, 1, 2, 3};
  std::vector<unsigned char> huge(200, 0xFF);
  huge[0] = 0, huge[1] = 1, huge[2] = 0, huge[3] = 0;
  std::vector<unsigned char> no_header = {1};
  for (auto* bytes : {&truncated, &short_one, &huge, &no_header}) ASSERT_TRUE(writer->write(bytes));
  ASSERT_TRUE(publisher.write(sample::wrench()));
  WrenchCommand received;
  ASSERT_TRUE(eventually([&] { return subscriber.take(received); }));
  EXPECT_EQ(received.seq, sample::wrench().seq);
  // And no sample is stuck at the head of the queue.
  ASSERT_TRUE(writer->write(&huge));
  ASSERT_TRUE(publisher.write(sample::wrench()));
  ASSERT_TRUE(eventually([&] { return subscriber.take(received); }));
}

}  // namespace
}  // namespace poinsot
