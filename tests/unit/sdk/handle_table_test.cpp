#include "handle_table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace camdir::sdk {
namespace {

TEST(HandleTable, FindsWhatWasInsertedAndNothingElse) {
    HandleTable<int> table;
    const std::uint64_t one = table.insert(std::make_shared<int>(1));
    const std::uint64_t two = table.insert(std::make_shared<int>(2));
    EXPECT_EQ(*table.find(one), 1);
    EXPECT_EQ(*table.find(two), 2);
    for (const std::uint64_t wrong :
         {std::uint64_t{0}, std::uint64_t{3}, two + 1, two + (std::uint64_t{1} << 32U), two & 0xffffffffU,
          std::numeric_limits<std::uint64_t>::max()}) {
        EXPECT_FALSE(table.find(wrong)) << wrong;
        EXPECT_FALSE(table.remove(wrong)) << wrong;
    }
}

TEST(HandleTable, ClosedHandleStaysClosedWhenItsSlotIsUsedAgain) {
    HandleTable<int> table;
    std::set<std::uint64_t> closed;
    for (int i = 0; i < 1000; ++i) {
        const std::uint64_t id = table.insert(std::make_shared<int>(i));
        EXPECT_TRUE(closed.insert(id).second) << "handed out twice";
        EXPECT_EQ(*table.remove(id), i);
        EXPECT_FALSE(table.find(id));
        EXPECT_FALSE(table.remove(id));
    }
}

TEST(HandleTable, RemovesTheChosenOnes) {
    HandleTable<int> table;
    const std::uint64_t even = table.insert(std::make_shared<int>(2));
    const std::uint64_t odd = table.insert(std::make_shared<int>(3));
    const auto removed = table.remove_if([](int value) { return value % 2 == 0; });
    ASSERT_EQ(removed.size(), 1U);
    EXPECT_EQ(*removed[0], 2);
    EXPECT_FALSE(table.find(even));
    EXPECT_TRUE(table.find(odd));
}

}  // namespace
}  // namespace camdir::sdk
