#include "http/files.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include "base/file.hpp"
#include "support/temporary_folder.hpp"
#include "test_server.hpp"

namespace camdir::http {
namespace {

namespace fs = std::filesystem;

std::string inflated(const std::string& gzip) {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    std::string text(1U << 22U, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(gzip.data()));
    stream.avail_in = static_cast<uInt>(gzip.size());
    stream.next_out = reinterpret_cast<Bytef*>(text.data());
    stream.avail_out = static_cast<uInt>(text.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    text.resize(stream.total_out);
    inflateEnd(&stream);
    return text;
}

TEST(Files, AreThoseOfTheFolderThatAPageConsistsOf) {
    const test::TemporaryFolder folder;
    for (const char* name : {"index.html", "a.js", "a.css", "a.svg", "secret.txt", ".hidden"})
        ASSERT_TRUE(write_file(folder / name, std::string("content of ") + name));
    fs::create_directory(folder / "inside.js");
    const auto without = Files::read(folder.path(), folder / "missing");
    EXPECT_FALSE(without) << "a folder is no file";
    fs::remove(folder / "inside.js");
    const auto files = Files::read(folder.path(), folder / "missing");
    ASSERT_TRUE(files) << files.error().message;
    for (const char* path : {"/", "/index.html", "/a.js", "/a.css", "/a.svg"})
        EXPECT_NE(files->find(path), nullptr) << path;
    for (const char* path : {"/secret.txt", "/.hidden", "", "//", "/../a.js", "/a.js/", "/three.js"})
        EXPECT_EQ(files->find(path), nullptr) << path;
    EXPECT_TRUE(files->three_missing());
    EXPECT_EQ(*files->find("/a.js")->text, "content of a.js");
    EXPECT_EQ(inflated(*files->find("/a.js")->gzip), "content of a.js");
}

TEST(Files, NeedAnIndex) {
    const test::TemporaryFolder folder;
    EXPECT_FALSE(Files::read(folder.path(), ""));
    EXPECT_FALSE(Files::read(folder / "missing", ""));
}

TEST(Files, AreBounded) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "index.html", std::string((4U << 20U) + 1, 'x')));
    EXPECT_FALSE(Files::read(folder.path(), ""));
}

TEST(Files, OfTheBuildTreeAreServedCompressedToWhoTakesThat) {
    const TestServer server;
    const auto plain = server.ask("GET", "/");
    EXPECT_EQ(plain.status, 200);
    EXPECT_EQ(plain.header.at("content-type"), "text/html; charset=utf-8");
    EXPECT_TRUE(plain.header.at("content-security-policy").starts_with("default-src 'self'"));
    EXPECT_FALSE(plain.header.contains("content-encoding"));
    EXPECT_EQ(plain.header.at("vary"), "Accept-Encoding");
    for (const char* accepted : {"gzip, br", "br;q=1.0, GZIP;q=0.5", "gzip;q=1"}) {
        const auto compressed = server.ask("GET", "/", "Accept-Encoding: " + std::string(accepted) + "\r\n");
        EXPECT_EQ(compressed.header.at("content-encoding"), "gzip");
        EXPECT_EQ(compressed.header.at("vary"), "Accept-Encoding");
        EXPECT_NE(compressed.header.at("etag"), plain.header.at("etag"));
        EXPECT_EQ(inflated(compressed.body), plain.body);
    }
    for (const char* refused : {"gzip;q=0", "br, gzip;q=0.000", "identity", "notgzip"})
        EXPECT_EQ(server.ask("GET", "/", "Accept-Encoding: " + std::string(refused) + "\r\n").body,
                  plain.body);
}

TEST(Files, AreNotSentToWhoHasThem) {
    const TestServer server;
    const std::string etag = server.ask("GET", "/").header.at("etag");
    test::HttpClient client(server.port());
    ASSERT_TRUE(client.send(test::http_request("GET", "/", "If-None-Match: " + etag + "\r\n")));
    EXPECT_EQ(client.receive(true).status, 304);
    EXPECT_EQ(client.ask("GET", "/", "If-None-Match: \"other\"\r\n").status, 200);
}

TEST(Files, OfAPageThatIsMissingPreventTheStart) {
    config::Http config;
    config.page = "/nowhere";
    const auto checked = Server::check(config);
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.error().message.find("/http/page"), std::string::npos) << checked.error().message;
}

}  // namespace
}  // namespace camdir::http
