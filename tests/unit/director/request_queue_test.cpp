#include "director/request_queue.hpp"

#include <gtest/gtest.h>

#include "stage.hpp"

namespace camdir::director {
namespace {

void expect_request(const ObserverNews& news, const std::string& observer_id, std::uint32_t target) {
    EXPECT_EQ(news.observer_id, observer_id);
    ASSERT_TRUE(news.request);
    EXPECT_EQ(news.request->target, target);
}

TEST(RequestQueue, TheNewestRequestTakesThePlaceOfTheOneThatWaits) {
    RequestQueue queue;
    for (std::uint32_t target = 1; target <= 1000; ++target) {
        queue.put(Stage::request("anna", target));
        queue.put(Stage::request("ben", target));
    }
    ObserverNews news = queue.take();
    expect_request(news, "anna", 1000);
    EXPECT_FALSE(news.ended);
    expect_request(queue.take(), "ben", 1000);
    EXPECT_TRUE(queue.empty());
}

TEST(RequestQueue, OfARequestThatEndsBeforeItIsTakenNothingIsLeft) {
    RequestQueue queue;
    for (int i = 0; i < 1000; ++i) {
        queue.put(Stage::request(std::to_string(i), 1));
        queue.end(std::to_string(i));
    }
    queue.end("nobody");
    EXPECT_TRUE(queue.empty());
}

TEST(RequestQueue, TheEndOfARequestThatWasTakenIsKept) {
    RequestQueue queue;
    queue.put(Stage::request("anna", 1));
    expect_request(queue.take(), "anna", 1);
    queue.put(Stage::request("anna", 2));
    queue.end("anna");
    queue.end("anna");
    ObserverNews news = queue.take();
    EXPECT_EQ(news.observer_id, "anna");
    EXPECT_TRUE(news.ended);
    EXPECT_FALSE(news.request);
    EXPECT_TRUE(queue.empty());
    queue.end("anna");
    EXPECT_TRUE(queue.empty());
}

// Who withdraws a request forgets the answer, and needs it again for the next one.
TEST(RequestQueue, ARequestAfterAnEndDoesNotHideIt) {
    RequestQueue queue;
    queue.put(Stage::request("anna", 1));
    expect_request(queue.take(), "anna", 1);
    for (int i = 0; i < 1000; ++i) {
        queue.end("anna");
        queue.put(Stage::request("anna", 1));
    }
    ObserverNews news = queue.take();
    EXPECT_TRUE(news.ended);
    expect_request(news, "anna", 1);
    EXPECT_TRUE(queue.empty());
    queue.end("anna");
    EXPECT_TRUE(queue.take().ended);
}

}  // namespace
}  // namespace camdir::director
