#include "live/gzip.hpp"

#include <zlib.h>

#include <cassert>
#include <new>

namespace camdir::live {

std::string gzip(std::span<const std::byte> content) {
    constexpr int gzip_window = 15 + 16;  // the largest window; 16: gzip's header, without a time
    constexpr int default_memory = 8;
    constexpr std::size_t beyond_zlib = 12;  // gzip's header and trailer, beyond those of zlib
    std::string file(compressBound(static_cast<uLong>(content.size())) + beyond_zlib, '\0');
    z_stream stream{};
    int status = deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window, default_memory,
                              Z_DEFAULT_STRATEGY);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    assert(status == Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(content.data()));
    stream.avail_in = static_cast<uInt>(content.size());
    stream.next_out = reinterpret_cast<Bytef*>(file.data());
    stream.avail_out = static_cast<uInt>(file.size());
    status = deflate(&stream, Z_FINISH);
    assert(status == Z_STREAM_END);
    file.resize(stream.total_out);
    deflateEnd(&stream);
    return file;
}

}  // namespace camdir::live
