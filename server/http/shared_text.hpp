// The body of an answer, without a copy for each connection that takes it.
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/optional/optional.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace camdir::http {

using Text = std::shared_ptr<const std::string>;  // null: empty

[[nodiscard]] inline Text share(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
}

// A body of Beast (the concept Body), for messages that are written.
struct SharedText {
    using value_type = Text;

    static std::uint64_t size(const value_type& text) { return text ? text->size() : 0; }

    class writer {
      public:
        using const_buffers_type = boost::asio::const_buffer;

        template <bool is_request, class Fields>
        writer(const boost::beast::http::header<is_request, Fields>& /*header*/, const value_type& text)
            : text_(text) {}
        void init(boost::beast::error_code& error) { error = {}; }
        boost::optional<std::pair<const_buffers_type, bool>> get(boost::beast::error_code& error) {
            error = {};
            if (!text_) return boost::none;
            return {{boost::asio::buffer(*text_), false}};
        }

      private:
        const value_type& text_;
    };
};

}  // namespace camdir::http
