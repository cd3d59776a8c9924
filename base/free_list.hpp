// Objects that tasks borrow: too large for a thread's stack, and too often wanted to be allocated each time.
#pragma once

#include <mutex>

namespace onset {

// Makes as many as are in use at one time, and keeps them. A T is not initialised, nor what the last borrower
// left in it cleared.
template <class T>
class FreeList {
 private:
  struct Node {
    Node* next;
    T object;
  };

 public:
  class Loan {
   public:
    explicit Loan(FreeList& list) : list_(list), node_(list.take()) {}
    ~Loan() { list_.give_back(node_); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    T& operator*() const { return node_->object; }

   private:
    FreeList& list_;
    Node* const node_;
  };

  FreeList() = default;
  ~FreeList() {
    while (Node* node = first_) first_ = node->next, delete node;
  }
  FreeList(const FreeList&) = delete;
  FreeList& operator=(const FreeList&) = delete;

 private:
  Node* take() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (Node* node = first_) return first_ = node->next, node;
    }
    return new Node;
  }
  void give_back(Node* node) noexcept {
    const std::lock_guard<std::mutex> lock(mutex_);
    node->next = first_, first_ = node;
  }

  std::mutex mutex_;
  Node* first_ = nullptr;
};

}  // namespace onset
