#include "webgl_platform.h"

#include <fmt/core.h>

#include <sys/socket.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace nusselt::parity {

namespace {

/// Shaders compute them as one image of 256 x 256 pixels, see tests/browser/shader_host.js.
constexpr std::size_t kBatch = 1 << 16;

} // namespace

/// The other end of the socket. shader_host.py describes requests and answers.
class WebglPlatform::Host {
public:
    explicit Host(int socket) : socket_(socket) {}

    /// \throws std::runtime_error if the answer is an error
    std::vector<std::byte> ask(const std::string& request, std::span<const std::byte> data) {
        const std::string head = fmt::format("{} {}\n", request, data.size());
        send(std::as_bytes(std::span(head)));
        send(data);
        std::string line;
        for (;;) {
            char c;
            receive(std::as_writable_bytes(std::span(&c, 1)));
            if (c == '\n') break;
            line += c;
        }
        const std::size_t space = line.find(' ');
        std::vector<std::byte> body(std::stoul(line.substr(space + 1)));
        receive(body);
        if (line.substr(0, space) != "ok")
            throw std::runtime_error(std::string(reinterpret_cast<const char*>(body.data()), body.size()));
        return body;
    }

    int next_shader() { return shaders_++; }

private:
    void send(std::span<const std::byte> bytes) const {
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent <= 0) throw std::runtime_error("the browser is gone");
            bytes = bytes.subspan(static_cast<std::size_t>(sent));
        }
    }

    void receive(std::span<std::byte> bytes) const {
        while (!bytes.empty()) {
            const ssize_t received = ::recv(socket_, bytes.data(), bytes.size(), 0);
            if (received <= 0) throw std::runtime_error("the browser is gone");
            bytes = bytes.subspan(static_cast<std::size_t>(received));
        }
    }

    int socket_;
    int shaders_ = 0;
};

namespace {

class WebglRunner : public ShaderRunner {
public:
    WebglRunner(std::shared_ptr<WebglPlatform::Host> host, int shader, std::size_t input_size)
        : host_(std::move(host)), shader_(shader), input_size_(input_size) {}

    std::vector<ShaderOutputs> run(std::span<const float> inputs) override {
        assert(inputs.size() % input_size_ == 0);
        std::vector<ShaderOutputs> results(inputs.size() / input_size_);
        for (std::size_t begin = 0; begin < results.size(); begin += kBatch) {
            const auto batch = std::as_writable_bytes(
                std::span(results).subspan(begin, std::min(kBatch, results.size() - begin)));
            const std::size_t count = batch.size() / sizeof(ShaderOutputs);
            const auto answer =
                host_->ask(fmt::format("run {} {}", shader_, count),
                           std::as_bytes(inputs.subspan(begin * input_size_, count * input_size_)));
            if (answer.size() != batch.size()) throw std::runtime_error("an answer of another size");
            std::copy(answer.begin(), answer.end(), batch.begin());
        }
        return results;
    }

private:
    std::shared_ptr<WebglPlatform::Host> host_;
    int shader_;
    std::size_t input_size_;
};

} // namespace

const WebglPlatform* WebglPlatform::shared() {
    const char* const socket = std::getenv("NUSSELT_SHADER_HOST");
    if (socket == nullptr) return nullptr;
    static const WebglPlatform platform(std::atoi(socket));
    return &platform;
}

WebglPlatform::WebglPlatform(int socket) : host_(std::make_shared<Host>(socket)) {}

std::unique_ptr<ShaderRunner> WebglPlatform::load(const VariantShader& shader, std::size_t input_size,
                                                  std::span<const std::uint32_t> words) const {
    host_->ask(fmt::format("shader {}", shader.shader.name), std::as_bytes(words));
    return std::make_unique<WebglRunner>(host_, host_->next_shader(), input_size);
}

} // namespace nusselt::parity
