#pragma once

#include <string>

namespace wellspaced {

/// Tells whether any other process uses the same job file, with certainty: the kernel drops the lock of a
/// process that dies, however it dies. Held for as long as the object lives.
///
/// Guarantees
/// 1. `alone()` right after construction: no other process (and no other object in this one) holds the lock,
/// so every
///    job that is marked as running belongs to a dead worker.
/// 2. Until `share()` nobody else gets past their constructor.
///
/// Errors: storage_unavailable naming the reason; the caller knows the path.
class ProcessLock {
 public:
  /// Creates the file when absent; it's never deleted (deleting it would let two processes lock two files).
  explicit ProcessLock(const std::string& path);
  ~ProcessLock();
  ProcessLock(const ProcessLock&) = delete;
  ProcessLock& operator=(const ProcessLock&) = delete;

  bool alone() const { return alone_; }
  /// Lets others in; to be called once the store is ready.
  void share();

 private:
  int file_ = -1;
  bool alone_ = false;
};

}  // namespace wellspaced
