#include "io/formats/zip.h"

#include <minizip/unzip.h>
#include <minizip/zip.h>

#include <algorithm>
#include <cstring>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// File interface for minizip: bytes to read, or a string to write to.
struct MemoryFile {
  std::string_view bytes;
  std::string* sink = nullptr;
  std::size_t position = 0;

  std::size_t size() const { return sink ? sink->size() : bytes.size(); }
};

MemoryFile& file_of(void* stream) {
  return *static_cast<MemoryFile*>(stream);
}

void* open_memory(void* opaque, const void*, int) {
  return opaque;
}

uLong read_memory(void*, void* stream, void* buffer, uLong size) {
  MemoryFile& file = file_of(stream);
  const std::size_t count = std::min<std::size_t>(size, file.size() - std::min(file.size(), file.position));
  if (count > 0)
    std::memcpy(buffer, (file.sink ? file.sink->data() : file.bytes.data()) + file.position, count);
  file.position += count;
  return count;
}

uLong write_memory(void*, void* stream, const void* buffer, uLong size) {
  MemoryFile& file = file_of(stream);
  if (size == 0) return 0;
  if (file.position + size > file.sink->size()) file.sink->resize(file.position + size);
  std::memcpy(file.sink->data() + file.position, buffer, size);
  file.position += size;
  return size;
}

ZPOS64_T tell_memory(void*, void* stream) {
  return file_of(stream).position;
}

long seek_memory(void*, void* stream, ZPOS64_T offset, int origin) {
  MemoryFile& file = file_of(stream);
  std::size_t base = 0;
  if (origin == ZLIB_FILEFUNC_SEEK_CUR) base = file.position;
  if (origin == ZLIB_FILEFUNC_SEEK_END) base = file.size();
  if (offset > file.size() || base + offset > file.size()) return -1;
  file.position = base + offset;
  return 0;
}

int succeed(void*, void*) {
  return 0;
}

zlib_filefunc64_def functions_for(MemoryFile& file) {
  zlib_filefunc64_def functions{};
  functions.zopen64_file = open_memory;
  functions.zread_file = read_memory;
  functions.zwrite_file = write_memory;
  functions.ztell64_file = tell_memory;
  functions.zseek64_file = seek_memory;
  functions.zclose_file = succeed;
  functions.zerror_file = succeed;
  functions.opaque = &file;
  return functions;
}

}  // namespace

struct ZipReader::Archive {
  explicit Archive(const Source& source) : name(source.name), file{source.bytes, nullptr, 0} {
    zlib_filefunc64_def functions = functions_for(file);
    handle = unzOpen2_64("", &functions);
    if (!handle) throw InputError(name + ": expected a zip archive, found none or a damaged one");
  }
  ~Archive() { unzClose(handle); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  [[noreturn]] void fail(const std::string& entry, const char* reason) const {
    throw InputError(name + ": the entry " + in_quotes(entry) + " of the archive " + reason);
  }

  const std::string& name;
  MemoryFile file;
  unzFile handle = nullptr;
};

ZipReader::ZipReader(const Source& source) : archive_(std::make_unique<Archive>(source)) {}
ZipReader::~ZipReader() = default;

std::optional<std::string> ZipReader::entry(const std::string& name) const {
  constexpr int ignore_case = 2;
  if (unzLocateFile(archive_->handle, name.c_str(), ignore_case) != UNZ_OK) return std::nullopt;
  if (unzOpenCurrentFile(archive_->handle) != UNZ_OK) archive_->fail(name, "cannot be opened");

  // Mesh text deflates by a factor of ten or so; what exceeds this by far is a bomb, whatever its header
  // states.
  constexpr std::size_t min_limit = std::size_t{64} << 20;
  constexpr std::size_t max_ratio = 200;
  const std::size_t limit = std::max(min_limit, max_ratio * archive_->file.size());
  std::string content;
  std::vector<char> block(1 << 16);
  int count = 0;
  while ((count = unzReadCurrentFile(archive_->handle, block.data(), static_cast<unsigned>(block.size()))) >
         0) {
    content.append(block.data(), static_cast<std::size_t>(count));
    if (content.size() > limit) archive_->fail(name, "inflates beyond any mesh");
  }
  const int closed = unzCloseCurrentFile(archive_->handle);
  if (count < 0 || closed != UNZ_OK) archive_->fail(name, "is damaged");
  return content;
}

std::string zip(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string bytes;
  MemoryFile file{{}, &bytes, 0};
  zlib_filefunc64_def functions = functions_for(file);
  const zipFile handle = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  if (!handle) throw OutputError("a zip archive cannot be started");
  zip_fileinfo info{};
  info.dosDate = 0x00210000;  // 1980-01-01 00:00, the first date that zip knows.
  for (const auto& [name, content] : entries) {
    bool good =
        zipOpenNewFileInZip64(handle, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                              Z_DEFAULT_COMPRESSION, content.size() > 0xffffffff) == ZIP_OK;
    // minizip takes 32-bit lengths.
    constexpr std::size_t block = std::size_t{1} << 30;
    for (std::size_t from = 0; good && from < content.size(); from += block)
      good = zipWriteInFileInZip(handle, content.data() + from,
                                 static_cast<unsigned>(std::min(block, content.size() - from))) == ZIP_OK;
    if (!good || zipCloseFileInZip(handle) != ZIP_OK)
      throw OutputError("the zip entry " + name + " cannot be written");
  }
  if (zipClose(handle, nullptr) != ZIP_OK) throw OutputError("a zip archive cannot be finished");
  return bytes;
}

}  // namespace stackabilization
