#include "scene/source.hpp"

#include <zip.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace camdir::scene {
namespace {

namespace fs = std::filesystem;

struct CloseArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseMember {
    void operator()(zip_file_t* member) const { zip_fclose(member); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using Member = std::unique_ptr<zip_file_t, CloseMember>;

bool is_file(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

struct MemberPath {
    std::string archive;
    std::string member;
};

// The last colon whose left side is a file: paths and members may hold colons themselves.
std::optional<MemberPath> split_member(const std::string& source) {
    for (std::size_t colon = source.rfind(':'); colon != std::string::npos && colon > 0;
         colon = source.rfind(':', colon - 1)) {
        if (is_file(source.substr(0, colon)))
            return MemberPath{source.substr(0, colon), source.substr(colon + 1)};
    }
    return std::nullopt;
}

Result<Archive> open_archive(const std::string& path) {
    int code = 0;
    Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
    if (archive) return archive;
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    return fail(path + ": cannot open as a zip archive: " + reason);
}

// Grows with what is unpacked: the size that the archive declares may be wrong.
Result<Bytes> unpack(zip_file_t* member, const std::string& source) {
    Bytes bytes;
    std::array<std::byte, 65536> block;
    for (;;) {
        const zip_int64_t got = zip_fread(member, block.data(), block.size());
        if (got < 0)
            return fail(source + ": cannot unpack: " + zip_error_strerror(zip_file_get_error(member)));
        if (got == 0) return bytes;
        if (bytes.size() + static_cast<std::size_t>(got) > max_member_bytes)
            return fail(source + ": larger than " + std::to_string(max_member_bytes) +
                        " bytes when unpacked, which is the limit for a member of an archive");
        bytes.insert(bytes.end(), block.begin(), block.begin() + got);
    }
}

std::string example_of_map(zip_t* archive) {
    const zip_int64_t count = zip_get_num_entries(archive, 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        const char* name = zip_get_name(archive, static_cast<zip_uint64_t>(i), 0);
        if (name != nullptr && fs::path(name).extension() == ".bsp") return name;
    }
    return "maps/NAME.bsp";
}

Result<Bytes> read_member(const MemberPath& path, const std::string& source) {
    const Result<Archive> archive = open_archive(path.archive);
    if (!archive) return tl::unexpected(archive.error());
    const Member member(zip_fopen(archive->get(), path.member.c_str(), 0));
    if (!member)
        return fail(path.archive + ": cannot open member '" + path.member +
                    "': " + zip_strerror(archive->get()) + "; an example of a member is " +
                    example_of_map(archive->get()));
    return unpack(member.get(), source);
}

bool is_zip(const Bytes& bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "PK\x03\x04", 4) == 0;
}

Result<Bytes> read_plain(const std::string& path) {
    Result<Bytes> bytes = read_file(path);
    if (!bytes || !is_zip(*bytes)) return bytes;
    const Result<Archive> archive = open_archive(path);
    if (!archive) return tl::unexpected(archive.error());
    return fail(path + ": is an archive; name a map in it, for example " + path + ":" +
                example_of_map(archive->get()));
}

}  // namespace

Result<Source> read_source(const std::string& source) {
    const std::optional<MemberPath> member = is_file(source) ? std::nullopt : split_member(source);
    Result<Bytes> bytes = member ? read_member(*member, source) : read_plain(source);
    if (!bytes) return tl::unexpected(bytes.error());
    const fs::path name = member ? member->member : source;
    std::string extension = name.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return Source{name.stem().string(), std::move(extension), std::move(*bytes)};
}

std::string beside(const std::string& source, const std::string& relative) {
    const std::optional<MemberPath> member = is_file(source) ? std::nullopt : split_member(source);
    if (!member) return (fs::path(source).parent_path() / relative).string();
    const fs::path path = fs::path(member->member).parent_path() / relative;
    return member->archive + ":" + path.lexically_normal().generic_string();
}

}  // namespace camdir::scene
