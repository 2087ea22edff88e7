// A client of HTTP that also sends what others would not. Independent of the server's library.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace camdir::test {

struct HttpAnswer {
    int status = 0;
    std::map<std::string, std::string> header;  // names in lower case
    std::string body;
};

// A connection to a server on this host. Throws when the server does not do what is waited for.
class HttpClient {
  public:
    explicit HttpClient(int port) : HttpClient() { connect(port); }
    // Takes its file descriptor and does not connect yet.
    HttpClient();
    ~HttpClient();
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;

    void connect(int port) const;
    // False when the server has closed the connection.
    [[nodiscard]] bool send(const std::string& bytes) const;
    // Waits for the next answer. One to HEAD has no body, and neither has 304.
    [[nodiscard]] HttpAnswer receive(bool to_head = false);
    // Sends a request with these lines in its header, and waits for the answer.
    [[nodiscard]] HttpAnswer ask(const std::string& method, const std::string& path,
                                 const std::string& header = "", const std::string& body = "");
    // Whether the server has closed the connection; what it sent and was not received is not seen then.
    [[nodiscard]] bool closed() const;

  private:
    // Waits for more bytes.
    void read_more();

    int socket_;
    std::string received_;
};

// "GET /path HTTP/1.1" with its header.
[[nodiscard]] std::string http_request(const std::string& method, const std::string& path,
                                       const std::string& header = "", const std::string& body = "");

}  // namespace camdir::test
