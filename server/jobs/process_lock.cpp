#include "server/jobs/process_lock.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/error.h"

namespace wellspaced {
namespace {

int lock(int file, int operation) {
  int result = 0;
  do {
    result = flock(file, operation);
  } while (result != 0 && errno == EINTR);
  return result;
}

std::string reason(int number) { return std::generic_category().message(number); }

}  // namespace

ProcessLock::ProcessLock(const std::string& path) {
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) {
    throw Error(ErrorCode::storage_unavailable,
                "can't create its lock file (" + reason(errno) +
                    "); create the directory, make it writable, or choose another path");
  }
  if (lock(file_, LOCK_EX | LOCK_NB) == 0) {
    alone_ = true;
    return;
  }
  // Somebody else is there: wait until they have made the store ready, then join them.
  if (errno == EWOULDBLOCK && lock(file_, LOCK_SH) == 0) return;
  const std::string why = reason(errno);
  close(file_);
  throw Error(ErrorCode::storage_unavailable,
              "can't lock its lock file (" + why + "); choose a path on a local disk");
}

ProcessLock::~ProcessLock() { close(file_); }

void ProcessLock::share() {
  // Changing the kind of a lock may let another opener in between. It would find no running job of ours, as
  // we haven't claimed any yet, and we wait until it is done.
  if (alone_ && lock(file_, LOCK_SH) != 0) {
    throw Error(ErrorCode::storage_unavailable,
                "can't share its lock (" + reason(errno) + "); choose a path on a local disk");
  }
}

}  // namespace wellspaced
