// The C structs across versions of the ABI: what of them a caller has, and the defaults of what it has not.
#pragma once

#include <camera_director/camera_director.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "failure.hpp"

namespace camdir::sdk {

// The struct's size in ABI version 2, the first whose callers are served by all later libraries. A field that
// is added at a struct's end changes sizeof, never this.
template <class Struct>
inline constexpr std::uint32_t least_size = 0;
template <>
inline constexpr std::uint32_t least_size<cdir_library_options> = 48;
template <>
inline constexpr std::uint32_t least_size<cdir_context_options> = 32;
template <>
inline constexpr std::uint32_t least_size<cdir_player> = 112;
template <>
inline constexpr std::uint32_t least_size<cdir_match_info> = 352;
template <>
inline constexpr std::uint32_t least_size<cdir_pose_frame> = 88;
template <>
inline constexpr std::uint32_t least_size<cdir_match_event> = 64;
template <>
inline constexpr std::uint32_t least_size<cdir_mover> = 136;
template <>
inline constexpr std::uint32_t least_size<cdir_mover_frame> = 64;
template <>
inline constexpr std::uint32_t least_size<cdir_observer_options> = 16;
template <>
inline constexpr std::uint32_t least_size<cdir_shot_request> = 40;
template <>
inline constexpr std::uint32_t least_size<cdir_camera> = 56;
template <>
inline constexpr std::uint32_t least_size<cdir_camera_frame> = 56;
template <>
inline constexpr std::uint32_t least_size<cdir_shot_status> = 280;
template <>
inline constexpr std::uint32_t least_size<cdir_view> = 24;
template <>
inline constexpr std::uint32_t least_size<cdir_observer_counters> = 48;

// Sets struct_size only; structs.cpp has those with other defaults than 0.
template <class Struct>
[[nodiscard]] Struct default_of() {
    Struct made{};
    made.struct_size = sizeof(Struct);
    return made;
}
template <>
[[nodiscard]] cdir_context_options default_of<cdir_context_options>();
template <>
[[nodiscard]] cdir_match_info default_of<cdir_match_info>();
template <>
[[nodiscard]] cdir_match_event default_of<cdir_match_event>();
template <>
[[nodiscard]] cdir_observer_options default_of<cdir_observer_options>();
template <>
[[nodiscard]] cdir_shot_request default_of<cdir_shot_request>();
template <>
[[nodiscard]] cdir_camera default_of<cdir_camera>();
template <>
[[nodiscard]] cdir_shot_status default_of<cdir_shot_status>();

// The default as far as `size` bytes hold it, and zeros beyond what this library knows.
template <class Struct>
void initialise(Struct* to, std::uint32_t size) {
    if (to == nullptr || size < sizeof to->struct_size) return;
    const Struct made = default_of<Struct>();
    std::memset(static_cast<void*>(to), 0, size);
    std::memcpy(static_cast<void*>(to), &made, std::min<std::size_t>(size, sizeof made));
    to->struct_size = size;
}

// Throws a Failure unless `parameter` is a struct of a version that this library serves.
template <class Struct>
void check_struct(const std::string& name, const Struct* parameter) {
    static_assert(least_size<Struct> > 0 && least_size<Struct> <= sizeof(Struct), "with its first size");
    if (parameter == nullptr) throw Failure{CDIR_INVALID_ARGUMENT, name + " is null"};
    const std::uint32_t size = parameter->struct_size;
    if (size >= least_size<Struct> && size <= sizeof(Struct)) return;
    const std::string found = name + ".struct_size is " + std::to_string(size) + ", not ";
    throw Failure{CDIR_INVALID_ARGUMENT,
                  size > sizeof(Struct)
                      ? found + "at most " + std::to_string(sizeof(Struct)) +
                            ": the caller was compiled for a later library, or has not initialised it"
                      : found + "at least " + std::to_string(least_size<Struct>) +
                            ": begin with its _default() or _init() function"};
}

// A checked copy of a caller's struct, with the defaults of the fields that it does not have.
template <class Struct>
[[nodiscard]] Struct read_struct(const std::string& name, const Struct* from) {
    check_struct(name, from);
    Struct read = default_of<Struct>();
    std::memcpy(static_cast<void*>(&read), from, from->struct_size);
    read.struct_size = sizeof(Struct);
    return read;
}

// Fills as much of a caller's struct as it has `size` bytes for.
template <class Struct>
void write_struct(Struct* to, Struct filled, std::uint32_t size) {
    filled.struct_size = size;
    std::memcpy(static_cast<void*>(to), &filled, size);
}
// For a checked struct.
template <class Struct>
void write_struct(Struct* to, const Struct& filled) {
    write_struct(to, filled, to->struct_size);
}

// A caller's array of `count` structs, at the distance that the first one's struct_size says. Throws a
// Failure when the array or its first struct is not what check_struct() expects; 0 structs need no array.
template <class Struct>
class StructArray {
  public:
    StructArray(const std::string& name, Struct* first, std::uint32_t count)
        : bytes_(reinterpret_cast<Byte*>(first)), count_(count) {
        if (count == 0) return;
        check_struct<std::remove_const_t<Struct>>(name, first);
        size_ = first->struct_size;
    }

    [[nodiscard]] std::uint32_t count() const { return count_; }
    // index < count().
    void write(std::uint32_t index, const Struct& filled) const { write_struct(at(index), filled, size_); }
    [[nodiscard]] Struct* at(std::uint32_t index) const {
        return reinterpret_cast<Struct*>(bytes_ + std::size_t{index} * size_);
    }

  private:
    using Byte = std::conditional_t<std::is_const_v<Struct>, const unsigned char, unsigned char>;
    Byte* bytes_;
    std::uint32_t count_;
    std::uint32_t size_ = 0;
};

// A checked copy of a caller's array. All its structs have the first one's struct_size.
template <class Struct>
[[nodiscard]] std::vector<Struct> read_array(const std::string& name, const Struct* first,
                                             std::uint32_t count) {
    const StructArray<const Struct> array(name, first, count);
    std::vector<Struct> read;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string element = name + "[" + std::to_string(i) + "]";
        read.push_back(read_struct(element, array.at(i)));
        if (array.at(i)->struct_size != first->struct_size)
            throw Failure{CDIR_INVALID_ARGUMENT, element + ".struct_size is not that of " + name + "[0]"};
    }
    return read;
}

}  // namespace camdir::sdk
