#include "director/request_queue.hpp"

#include <utility>

namespace camdir::director {

void RequestQueue::put(ObserverRequest request) {
    ObserverNews& news = news_of(request.observer_id);
    news.request = std::move(request);
}

void RequestQueue::end(const std::string& observer_id) {
    if (taken_.contains(observer_id)) {
        ObserverNews& news = news_of(observer_id);
        news.ended = true;
        news.request.reset();
    } else if (const auto entry = places_.find(observer_id); entry != places_.end()) {
        waiting_.erase(entry->second);
        places_.erase(entry);
    }
}

ObserverNews RequestQueue::take() {
    ObserverNews news = std::move(waiting_.front());
    waiting_.pop_front();
    places_.erase(news.observer_id);
    if (news.request)
        taken_.insert(news.observer_id);
    else
        taken_.erase(news.observer_id);
    return news;
}

ObserverNews& RequestQueue::news_of(const std::string& observer_id) {
    const auto [entry, is_new] = places_.try_emplace(observer_id);
    if (is_new) entry->second = waiting_.insert(waiting_.end(), ObserverNews{observer_id});
    return *entry->second;
}

}  // namespace camdir::director
