// What a process keeps of things that come and go.
#pragma once

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

namespace camdir::test {

// Bytes that the heap has grown by for each of `times` calls, in the round that kept least: buffers that grow
// to their size, and what other threads need meanwhile, are not kept every time. 0 where a sanitizer
// allocates.
template <class ComeAndGo>
[[nodiscard]] double bytes_kept(int times, ComeAndGo come_and_go) {
    constexpr int rounds = 4;
    constexpr std::chrono::milliseconds settling{20};  // threads of DDS free what has gone
    const auto in_use = [&] {
        std::this_thread::sleep_for(settling);
        return static_cast<double>(::mallinfo2().uordblks);
    };
    double least = std::numeric_limits<double>::max();
    for (int round = 0; round < rounds; ++round) {
        const double before = in_use();
        for (int i = 0; i < times; ++i)
            come_and_go();
        least = std::min(least, (in_use() - before) / times);
    }
    return least;
}

}  // namespace camdir::test
