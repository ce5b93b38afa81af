#pragma once

#include <sys/types.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

namespace photopic {

/// A file in memory, as a FILE: libjpeg writes to nothing else, and ends the process when that fails. So what
/// finds no memory is swallowed, and told by bytes().
class MemoryFile {
 public:
  MemoryFile() : stream_(::fopencookie(this, "w", {nullptr, write, seek, nullptr})) {
    if (!stream_) throw std::bad_alloc();
  }
  ~MemoryFile() {
    std::fclose(stream_);
    std::free(data_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  FILE* stream() const { return stream_; }
  /// What was written, until more is.
  std::string_view bytes() const {
    std::fflush(stream_);
    if (incomplete_) throw std::bad_alloc();
    return {data_, size_};
  }

 private:
  static ssize_t write(void* cookie, const char* bytes, std::size_t count) {
    MemoryFile& file = *static_cast<MemoryFile*>(cookie);
    if (!file.incomplete_ && file.reserve(file.at_ + count)) {
      if (file.at_ > file.size_) std::memset(file.data_ + file.size_, 0, file.at_ - file.size_);
      std::memcpy(file.data_ + file.at_, bytes, count);
      file.size_ = std::max(file.size_, file.at_ + count);
    }
    file.at_ += count;
    return static_cast<ssize_t>(count);
  }

  static int seek(void* cookie, off64_t* offset, int origin) {
    MemoryFile& file = *static_cast<MemoryFile*>(cookie);
    const std::size_t from = origin == SEEK_CUR ? file.at_ : origin == SEEK_END ? file.size_ : 0;
    *offset += static_cast<off64_t>(from);
    if (*offset < 0) return -1;
    file.at_ = static_cast<std::size_t>(*offset);
    return 0;
  }

  bool reserve(std::size_t size) {
    if (size <= capacity_) return true;
    const std::size_t capacity = std::max({size, 2 * capacity_, std::size_t{1} << 16});
    char* data = static_cast<char*>(std::realloc(data_, capacity));  // moves pages, where a vector copies
    incomplete_ = data == nullptr;
    if (incomplete_) return false;
    data_ = data, capacity_ = capacity;
    return true;
  }

  char* data_ = nullptr;
  std::size_t at_ = 0, size_ = 0, capacity_ = 0;
  bool incomplete_ = false;
  FILE* stream_;
};

}  // namespace photopic
