#include "genu/store/checkpoint.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "genu/core/binary_archive.h"
#include "genu/core/file_checksum.h"
#include "genu/core/program_hash.h"
#include "genu/path/fields.h"
#include "genu/store/tolerances.h"

namespace genu {

template <typename Archive>
void serialize(Archive& a, LayerTotals& x) {
  a(x.force, x.moment, x.area, x.max_pressure, x.mean_pressure, x.max_depth, x.most_used, x.centre, x.centre_a,
    x.points);
}
template <typename Archive>
void serialize(Archive& a, LayerReport& x) {
  a(x.total, x.regions);
}
/// Of a pose that was solved: `given` is for others.
template <typename Archive>
void serialize(Archive& a, PoseRecord& x) {
  a(x.point, x.pair_gap, x.layers);
}

namespace {

constexpr const char* kFirstLine = "genu checkpoint 1: genu run SCENE --out DIR --resume goes on from here\n";
constexpr std::size_t kHash = 32, kHead = sizeof(std::uint64_t) + kHash;

template <typename... Fields>
std::string packed(const Fields&... fields) {
  BinaryWriter archive;
  archive(fields...);
  return archive.take();
}

/// False where the bytes hold something else.
template <typename... Fields>
bool unpack(const std::string& bytes, Fields&... fields) {
  try {
    BinaryReader archive(bytes);
    archive(fields...);
    return true;
  } catch (const BrokenArchive&) {
    return false;
  }
}

/// Locks the file. A killed run takes a moment to release it.
bool locked(int descriptor) {
  for (int k = 0; k < kMaxLockTries; ++k) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    ::usleep(kLockPause);
  }
  return false;
}

bool is_regular(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

std::string why_it_failed() { return errno == ELOOP ? "is a symbolic link" : std::strerror(errno); }

}  // namespace

std::string beside(std::string folder, const char* ending) {
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  return folder + ending;
}

Checkpoint::Checkpoint(const std::string& folder, Inputs inputs, double every)
    : file_(beside(folder, ".checkpoint")), inputs_(std::move(inputs)), every_(every), next_(every) {}

Checkpoint::~Checkpoint() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

/// Opens the file for writing, for this run alone; what is no checkpoint of genu stays what it is.
bool Checkpoint::open() {
  if (descriptor_ >= 0) return true;
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor_ < 0) {
    problem_ = why_it_failed();
    return false;
  }
  std::string start(std::strlen(kFirstLine), '\0');
  const bool regular = is_regular(descriptor_);
  const ssize_t read = regular ? ::pread(descriptor_, start.data(), start.size(), 0) : -1;
  if (!regular)
    problem_ = "is no regular file, and is not replaced";
  else if (!locked(descriptor_))
    problem_ = "another run is writing it";
  else if (read != 0 &&
           std::string(kFirstLine).rfind(start.substr(0, static_cast<std::size_t>(std::max<ssize_t>(read, 0))), 0) != 0)
    problem_ = "is no checkpoint of genu, and is not replaced";
  else
    return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

std::string Checkpoint::blocked() {
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file_, ignored)) || open()) return {};
  return problem_;
}

/// Adds a part as a whole: what of it does not find room is cut off again.
bool Checkpoint::append(const std::string& part) {
  const std::string hash = checksum(hash_ + part).xxh128;
  const auto length = static_cast<std::uint64_t>(part.size());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  bytes += hash + part;
  if (size_ == 0) bytes.insert(0, kFirstLine);
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) problem_ = why_it_failed();
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(size_ + done));
    if (n <= 0) {
      problem_ = why_it_failed();
      if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) problem_ += "; its end cannot be cut off";
      return false;
    }
    done += static_cast<std::size_t>(n);
  }
  size_ += bytes.size();
  hash_ = hash;
  problem_.clear();
  return true;
}

void Checkpoint::add(const std::vector<PoseRecord>& all_records, const std::vector<PathEvent>& all_events,
                     const std::function<std::string()>& save) {
  const double begun = timer_.seconds();
  if (begun < next_) return;
  write(all_records, all_events, save);
  // Where writing is slow, or fails again and again on ever more rows, it may not take more than its share of the run.
  const double now = timer_.seconds();
  if (every_ > 0 || !problem_.empty()) next_ = std::max(begun + every_, now + (now - begun) / kCheckpointShare);
}

void Checkpoint::write(const std::vector<PoseRecord>& all_records, const std::vector<PathEvent>& all_events,
                       const std::function<std::string()>& save) {
  if (!open() || (size_ == 0 && !append(packed(program_hash(), inputs_)))) return;
  // What this run has not added yet.
  const std::vector<PoseRecord> rows(all_records.begin() + static_cast<std::ptrdiff_t>(rows_), all_records.end());
  const std::vector<PathEvent> more(all_events.begin() + static_cast<std::ptrdiff_t>(events_), all_events.end());
  if (!append(packed(rows, more, save()))) return;
  rows_ = all_records.size();
  events_ = all_events.size();
}

/// The parts of a file, one after another, as far as they are whole.
bool Checkpoint::read_parts(const std::string& content, Diagnostics& out) {
  size_ = std::strlen(kFirstLine);
  bool first = true;
  while (size_ + kHead <= content.size()) {
    std::uint64_t length = 0;
    std::memcpy(&length, content.data() + size_, sizeof length);
    if (length > content.size() - size_ - kHead) break;
    const std::string part = content.substr(size_ + kHead, static_cast<std::size_t>(length));
    const std::string hash = checksum(hash_ + part).xxh128;
    if (content.compare(size_ + sizeof length, kHash, hash) != 0) break;
    std::string program, saved;
    Inputs bound;
    std::vector<PoseRecord> rows;
    std::vector<PathEvent> more;
    if (!(first ? unpack(part, program, bound) : unpack(part, rows, more, saved))) break;
    if (first && program != program_hash())
      out.error(Code::cannot_resume, file_,
                "was written by another build of genu, or with other libraries or on another processor: run "
                "without --resume to compute again");
    for (std::size_t i = 0; first && i < inputs_.size() && !out.has_errors(); ++i)
      if (i >= bound.size() || bound[i].second != inputs_[i].second)
        out.error(Code::cannot_resume, inputs_[i].first,
                  "has changed since " + file_ +
                      " was written: its rows belong to another scene. Run without "
                      "--resume to compute again");
    if (out.has_errors()) return false;
    records.insert(records.end(), rows.begin(), rows.end());
    events.insert(events.end(), more.begin(), more.end());
    path = std::move(saved);
    first = false;
    hash_ = hash;
    size_ += kHead + static_cast<std::size_t>(length);
  }
  if (first) size_ = 0;
  if (size_ < content.size() && !records.empty())
    out.warning(Code::broken_file, file_,
                fmt::format("its last {} bytes are damaged and left out; {} rows are used", content.size() - size_,
                            records.size()));
  return true;
}

bool Checkpoint::resume(Diagnostics& out) {
  if (!std::filesystem::exists(std::filesystem::symlink_status(file_))) {
    out.warning(Code::cannot_resume, file_, "does not exist: computed from the start");
    return true;
  }
  if (!open()) {
    out.error(Code::cannot_resume, file_, problem_);
    return false;
  }
  std::ostringstream read;
  read << std::ifstream(file_, std::ios::binary).rdbuf();
  const std::string content = std::move(read).str();
  if (!read_parts(content, out)) return false;
  rows_ = records.size();
  events_ = events.size();
  if (path.empty() && !content.empty()) out.warning(Code::cannot_resume, file_, "has no rows: computed from the start");
  return true;
}

bool Checkpoint::earlier() const {
  std::error_code ignored;
  return size_ == 0 && std::filesystem::exists(file_, ignored);
}

void Checkpoint::remove() {
  std::error_code ignored;
  if (std::filesystem::exists(file_, ignored) && open()) std::filesystem::remove(file_, ignored);
  size_ = rows_ = events_ = 0;
  hash_.clear();
}

}  // namespace genu
