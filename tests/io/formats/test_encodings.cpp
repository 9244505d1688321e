#include <zlib.h>

#include <string>

#include "stackabilization/io/encodings.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

std::string inflated(const std::string& bytes, std::size_t expected) {
  z_stream stream{};
  REQUIRE(inflateInit2(&stream, 15 + 16) == Z_OK);
  std::string result(expected + 1, '?');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  CHECK(inflate(&stream, Z_FINISH) == Z_STREAM_END);
  CHECK(stream.avail_in == 0);
  result.resize(stream.total_out);
  inflateEnd(&stream);
  return result;
}

}  // namespace

TEST_CASE("base64: the examples of RFC 4648, and bytes that are no text") {
  CHECK(base64_text("") == "");
  CHECK(base64_text("f") == "Zg==");
  CHECK(base64_text("fo") == "Zm8=");
  CHECK(base64_text("foo") == "Zm9v");
  CHECK(base64_text("foob") == "Zm9vYg==");
  CHECK(base64_text("fooba") == "Zm9vYmE=");
  CHECK(base64_text("foobar") == "Zm9vYmFy");
  CHECK(base64_text(std::string("\0\xff\xfb", 3)) == "AP/7");
}

TEST_CASE("gzip: what is compressed comes back, and the same bytes give the same bytes") {
  std::string noise;
  unsigned state = 1;
  for (int k = 0; k < 100000; ++k) noise += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
  for (const std::string& bytes : {std::string(), std::string("a"), std::string(1000000, 'x'), noise}) {
    const std::string packed = gzip_bytes(bytes);
    CHECK(inflated(packed, bytes.size()) == bytes);
    CHECK(gzip_bytes(bytes) == packed);
  }
  CHECK(gzip_bytes(std::string(1000000, 'x')).size() < 2000);
}
