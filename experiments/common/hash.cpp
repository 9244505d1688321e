#include "common/hash.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include "stackabilization/core/errors.h"

namespace stackabilization::experiments {
namespace {

class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) state_ = (state_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  std::string text() const {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    for (int shift = 60; shift >= 0; shift -= 4) result += digits[state_ >> shift & 15U];
    return result;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

}  // namespace

std::string text_hash(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.text();
}

std::string file_hash(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be opened for reading");
  Hash hash;
  std::vector<char> block(1 << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    hash.add({block.data(), static_cast<std::size_t>(file.gcount())});
  if (file.bad()) throw InputError(path.string() + ": cannot be read");
  return hash.text();
}

}  // namespace stackabilization::experiments
