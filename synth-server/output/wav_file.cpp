// SPDX-License-Identifier: MIT
// RIFF/WAVE as in Microsoft's "Multiple channel audio data and WAVE files" (2007): IEEE float, and
// WAVE_FORMAT_EXTENSIBLE above two channels, without a speaker mask, since tiles have no place in
// a living room. Beyond 4 GiB the file becomes RF64 (EBU Tech 3306): its true sizes stand in a
// chunk for which room is kept from the start.
#include "synth-server/output/wav_file.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <stdexcept>
#include <string>

#include "program/files.hpp"

namespace splash::synth {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie");

constexpr std::uint16_t kFloatFormat = 3;
constexpr std::uint16_t kExtensible = 0xFFFE;
/// KSDATAFORMAT_SUBTYPE_IEEE_FLOAT behind its first two bytes, which are kFloatFormat.
constexpr std::array<unsigned char, 14> kSubtypeTail = {0x00, 0x00, 0x00, 0x00, 0x10, 0x00, 0x80,
                                                        0x00, 0x00, 0xAA, 0x00, 0x38, 0x9B, 0x71};

class Header {
 public:
  void text(const char* four) { bytes_.append(four, 4); }
  void u16(std::uint64_t value) { number(value, 2); }
  void u32(std::uint64_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  void bytes(const unsigned char* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes_.push_back(static_cast<char>(data[i]));
  }
  [[nodiscard]] const std::string& str() const { return bytes_; }

 private:
  void number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<char>((value >> (8 * i)) & 0xFFU));
  }
  std::string bytes_;
};

/// What a chunk's size says when the true one stands in ds64, and the size of that chunk.
constexpr std::uint64_t kSeeElsewhere = 0xFFFFFFFF;
constexpr std::uint64_t kBigSizes = 28;

/// `limit`: largest RIFF size; beyond it the header is RF64's.
std::string header(int channels, int sample_rate, std::int64_t frame_count, std::uint64_t limit) {
  const bool extensible = channels > 2;
  const auto frames = static_cast<std::uint64_t>(frame_count);
  const auto frame_size = static_cast<std::uint64_t>(channels) * sizeof(float);
  const std::uint64_t data_size = frames * frame_size;
  const std::uint64_t format_size = extensible ? 40 : 18;
  const std::uint64_t riff_size = 4 + (8 + kBigSizes) + (8 + format_size) + (8 + 4) + 8 + data_size;
  const bool big = riff_size > limit;
  Header h;
  h.text(big ? "RF64" : "RIFF");
  h.u32(big ? kSeeElsewhere : riff_size);
  h.text("WAVE");
  h.text(big ? "ds64" : "JUNK");
  h.u32(kBigSizes);
  h.u64(big ? riff_size : 0);
  h.u64(big ? data_size : 0);
  h.u64(big ? frames : 0);
  h.u32(0);  // no further sizes
  h.text("fmt ");
  h.u32(format_size);
  h.u16(extensible ? kExtensible : kFloatFormat);
  h.u16(static_cast<std::uint64_t>(channels));
  h.u32(static_cast<std::uint64_t>(sample_rate));
  h.u32(static_cast<std::uint64_t>(sample_rate) * frame_size);
  h.u16(frame_size);
  h.u16(32);                   // bits per sample
  h.u16(extensible ? 22 : 0);  // size of what follows
  if (extensible) {
    h.u16(32);  // valid bits
    h.u32(0);   // no speaker positions
    h.u16(kFloatFormat);
    h.bytes(kSubtypeTail.data(), kSubtypeTail.size());
  }
  h.text("fact");
  h.u32(4);
  h.u32(big ? kSeeElsewhere : frames);
  h.text("data");
  h.u32(big ? kSeeElsewhere : data_size);
  return h.str();
}

}  // namespace

WavFile::WavFile(const std::filesystem::path& path, int channels, int sample_rate,
                 std::uint64_t riff_limit)
    : path_(path), channels_(channels), sample_rate_(sample_rate), riff_limit_(riff_limit) {
  // The format counts channels, and bytes per frame, in 16 bits.
  if (channels < 1 || channels > 16383) {
    throw std::invalid_argument(path.string() + ": a WAV file has 1 to 16383 float channels, not " +
                                std::to_string(channels));
  }
  errno = 0;
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) fail("create");
  write_header();
}

WavFile::~WavFile() {
  try {
    close();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): see the declaration
  }
}

void WavFile::fail(const std::string& action) const {
  throw program::WriteError(path_.string() + ": cannot " + action, errno);
}

void WavFile::write_header() {
  errno = 0;
  const std::string bytes = header(channels_, sample_rate_, frames_, riff_limit_);
  if (!file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) fail("write");
  header_frames_ = frames_;
}

/// The samples first: a header never speaks of samples that are not in the file.
void WavFile::update_header() {
  errno = 0;
  if (!file_.flush()) fail("write");
  file_.seekp(0);
  write_header();
  file_.seekp(0, std::ios::end);
  if (!file_.flush()) fail("write");
}

void WavFile::write(const float* const* planar, int frames) {
  const auto width = static_cast<std::size_t>(channels_);
  const auto count = static_cast<std::size_t>(frames);
  interleaved_.resize(count * width);
  for (std::size_t c = 0; c < width; ++c) {
    for (std::size_t i = 0; i < count; ++i) interleaved_[i * width + c] = planar[c][i];
  }
  errno = 0;
  const auto bytes = static_cast<std::streamsize>(interleaved_.size() * sizeof(float));
  if (!file_.write(reinterpret_cast<const char*>(interleaved_.data()), bytes)) fail("write");
  frames_ += frames;
  if (frames_ - header_frames_ >= sample_rate_) update_header();
}

void WavFile::close() {
  if (!file_.is_open()) return;
  update_header();
  errno = 0;
  file_.close();
  if (file_.fail()) fail("close");
}

}  // namespace splash::synth
