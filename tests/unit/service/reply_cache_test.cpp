#include "poinsot/service/reply_cache.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

Reply reply(std::uint64_t client, std::uint64_t seq, std::uint64_t first_frame = 0) {
  Reply r;
  r.client = client;
  r.seq = seq;
  r.first_frame = first_frame;
  return r;
}

TEST(ReplyCache, FindsTheReplyOfTheSameClientAndSeqOnly) {
  ReplyCache cache;
  cache.insert(reply(1, 7, 42));
  ASSERT_NE(cache.find(1, 7), nullptr);
  EXPECT_EQ(cache.find(1, 7)->first_frame, 42u);
  EXPECT_EQ(cache.find(7, 1), nullptr);
  EXPECT_EQ(cache.find(1, 8), nullptr);
}

TEST(ReplyCache, KeepsTheFirstReply) {
  ReplyCache cache;
  cache.insert(reply(1, 7, 42));
  cache.insert(reply(1, 7, 43));
  EXPECT_EQ(cache.find(1, 7)->first_frame, 42u);
  EXPECT_EQ(cache.size(), 1u);
}

TEST(ReplyCache, KnowsWhatIsUnderWayUntilItsReplyComes) {
  ReplyCache cache;
  cache.expect(1, 7);
  EXPECT_TRUE(cache.is_under_way(1, 7));
  EXPECT_FALSE(cache.is_under_way(1, 8));
  EXPECT_EQ(cache.find(1, 7), nullptr);
  cache.insert(reply(1, 7, 42));
  EXPECT_FALSE(cache.is_under_way(1, 7));
  EXPECT_NE(cache.find(1, 7), nullptr);
}

TEST(ReplyCache, ForgetsTheOldestBeyondItsCapacity) {
  ReplyCache cache;
  for (std::uint64_t n = 1; n <= ReplyCache::kCapacity + 3; ++n) cache.insert(reply(n % 5, n));
  EXPECT_EQ(cache.size(), ReplyCache::kCapacity);
  EXPECT_EQ(cache.find(3, 3), nullptr);
  EXPECT_NE(cache.find(4, 4), nullptr);
  EXPECT_NE(cache.find((ReplyCache::kCapacity + 3) % 5, ReplyCache::kCapacity + 3), nullptr);
}

}  // namespace
}  // namespace poinsot
