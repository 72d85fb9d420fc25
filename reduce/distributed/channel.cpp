#include "reduce/distributed/channel.hpp"

#include <cerrno>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

Channel::Channel(int descriptor, std::string peer) : descriptor_(descriptor), peer_(std::move(peer)) {}

Channel::~Channel() { close(descriptor_); }

void Channel::send(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t sent = write(descriptor_, next, bytes);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw ComputationError(fmt::format("the connection to {} is broken", peer_));
    next += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
}

bool Channel::receive_if_any(void* data, std::size_t bytes) {
  char* next = static_cast<char*>(data);
  std::size_t left = bytes;
  while (left > 0) {
    const ssize_t got = read(descriptor_, next, left);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 && left == bytes) return false;
    if (got <= 0) throw ComputationError(fmt::format("the connection to {} is broken", peer_));
    next += got;
    left -= static_cast<std::size_t>(got);
  }
  return true;
}

void Channel::receive(void* data, std::size_t bytes) {
  if (bytes > 0 && !receive_if_any(data, bytes))
    throw ComputationError(fmt::format("the connection to {} is broken", peer_));
}

void Channel::send_text(const std::string& text) {
  send_number(static_cast<std::int64_t>(text.size()));
  send(text.data(), text.size());
}

std::string Channel::receive_text() {
  std::string text(static_cast<std::size_t>(receive_number<std::int64_t>()), '\0');
  receive(text.data(), text.size());
  return text;
}

void Channel::send_outcome(const Outcome& outcome) {
  send_number(outcome.kind);
  send_text(outcome.message);
}

Outcome Channel::receive_outcome() {
  Outcome outcome;
  outcome.kind = receive_number<Outcome::Kind>();
  outcome.message = receive_text();
  return outcome;
}

}  // namespace bielle::reduce
