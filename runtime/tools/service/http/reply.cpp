#include "tools/service/http/reply.h"

#include <array>
#include <atomic>
#include <boost/asio/post.hpp>
#include <cstddef>
#include <new>
#include <utility>

namespace sgm::service::http {

/// An answer on its way to the server's thread. Includes memory for the handler that Asio posts, so that posting cannot
/// fail.
struct Letter {
  explicit Letter(std::weak_ptr<Answered> receiver) : to(std::move(receiver)) {}

  std::weak_ptr<Answered> to;
  std::optional<Response> response;
  alignas(std::max_align_t) std::array<std::byte, 256> room{};
  /// Whether `room` is in use. Needs no lock: Asio allocates before it passes the call to another thread.
  bool room_taken = false;
};

namespace {

/// An allocator that uses the memory inside a Letter, or the heap if that memory is too small or in use.
template <class T>
struct LetterAllocator {
  using value_type = T;

  explicit LetterAllocator(std::shared_ptr<Letter> of) : letter(std::move(of)) {}
  template <class Other>
  LetterAllocator(const LetterAllocator<Other>& other) : letter(other.letter) {}

  T* allocate(size_t count) {
    if (letter->room_taken || count * sizeof(T) > letter->room.size())
      return static_cast<T*>(::operator new(count * sizeof(T)));
    letter->room_taken = true;
    return reinterpret_cast<T*>(letter->room.data());
  }
  void deallocate(T* at, size_t) noexcept {
    if (static_cast<void*>(at) == letter->room.data())
      letter->room_taken = false;
    else
      ::operator delete(at);
  }
  template <class Other>
  bool operator==(const LetterAllocator<Other>& other) const {
    return letter == other.letter;
  }

  std::shared_ptr<Letter> letter;
};

struct Delivery {
  using allocator_type = LetterAllocator<std::byte>;
  allocator_type get_allocator() const { return allocator_type(letter); }

  void operator()() {
    if (const std::shared_ptr<Answered> to = letter->to.lock()) to->deliver(std::move(letter->response));
  }

  std::shared_ptr<Letter> letter;
};

/// The state that all copies of a Reply share. It posts its Letter to the server's thread exactly once: with the answer
/// when the first copy is called, or without an answer when all copies have been destroyed.
class Ticket {
 public:
  Ticket(std::shared_ptr<Mailbox> mailbox, std::shared_ptr<Letter> letter)
      : mailbox_(std::move(mailbox)), letter_(std::move(letter)) {}
  Ticket(const Ticket&) = delete;
  Ticket& operator=(const Ticket&) = delete;
  ~Ticket() {
    if (!used_.exchange(true)) mailbox_->post(std::move(letter_));
  }

  void use(Response response) {
    if (used_.exchange(true)) return;
    letter_->response = std::move(response);
    mailbox_->post(std::move(letter_));
  }

 private:
  std::shared_ptr<Mailbox> mailbox_;
  std::shared_ptr<Letter> letter_;
  std::atomic<bool> used_{false};
};

}  // namespace

void Mailbox::close() {
  const std::lock_guard lock(mutex_);
  context_ = nullptr;
}

void Mailbox::post(std::shared_ptr<Letter> letter) noexcept {
  const std::lock_guard lock(mutex_);
  if (context_) boost::asio::post(*context_, Delivery{std::move(letter)});
}

Reply makeReply(std::shared_ptr<Mailbox> mailbox, std::weak_ptr<Answered> to) {
  auto letter = std::make_shared<Letter>(std::move(to));
  auto ticket = std::make_shared<Ticket>(std::move(mailbox), std::move(letter));
  return [ticket](Response response) { ticket->use(std::move(response)); };
}

}  // namespace sgm::service::http
