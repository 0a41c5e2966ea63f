#include "exchange.h"

#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

namespace genu::peers {
namespace {

constexpr const char* kKnee = "genu-peers-knee";
constexpr const char* kPoses = "genu-peers-poses";

template <std::size_t N>
std::ostream& operator<<(std::ostream& out, const std::array<double, N>& values) {
  for (const double v : values) out << ' ' << v;
  return out;
}

template <std::size_t N>
std::istream& operator>>(std::istream& in, std::array<double, N>& values) {
  for (double& v : values) in >> v;
  return in;
}

std::string write_lines(const std::string& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(path);
  out.precision(std::numeric_limits<double>::max_digits10);
  write(out);
  out.close();
  return out ? std::string() : path + ": cannot be written";
}

/// Line by line: the first is `title`, of the others `read` gets the first word and the rest, and says whether they
/// fit.
std::string read_lines(const std::string& path, const std::string& title,
                       const std::function<bool(const std::string&, std::istream&)>& read) {
  std::ifstream in(path);
  std::string line, word;
  if (!std::getline(in, line) || line != title) return path + ": is no " + title + " file";
  for (int number = 2; std::getline(in, line); ++number) {
    std::istringstream words(line);
    if (!(words >> word) || !read(word, words) || words.fail() || !(words >> std::ws).eof())
      return path + ":" + std::to_string(number) + ": cannot be read: " + line;
  }
  return {};
}

}  // namespace

std::string write_knee(const Knee& knee, const std::string& path) {
  return write_lines(path, [&](std::ostream& out) {
    out << kKnee << "\nstart" << knee.start << "\nlength " << knee.length << '\n';
    for (const double flexion : knee.flexions) out << "flexion " << flexion << '\n';
    for (const Spring& s : knee.springs)
      out << "spring" << s.femur << s.tibia << ' ' << s.stiffness << ' ' << s.slack_length << '\n';
    for (const ContactPair& p : knee.pairs) out << "pair " << p.mesh << p.origin << p.normal << '\n';
  });
}

std::string read_knee(const std::string& path, Knee& knee) {
  knee = {};
  return read_lines(path, kKnee, [&](const std::string& word, std::istream& in) {
    if (word == "start") return static_cast<bool>(in >> knee.start);
    if (word == "length") return static_cast<bool>(in >> knee.length);
    if (word == "flexion") return static_cast<bool>(in >> knee.flexions.emplace_back());
    if (word == "pair") {
      ContactPair& p = knee.pairs.emplace_back();
      return static_cast<bool>(in >> p.mesh >> p.origin >> p.normal);
    }
    if (word != "spring") return false;
    Spring& s = knee.springs.emplace_back();
    return static_cast<bool>(in >> s.femur >> s.tibia >> s.stiffness >> s.slack_length);
  });
}

std::string write_path(const FoundPath& found, const std::string& path) {
  return write_lines(path, [&](std::ostream& out) {
    out << kPoses << "\nseconds " << found.seconds << '\n';
    for (const FoundPose& p : found.poses) out << "pose" << p.coordinates << p.contact << ' ' << p.settled << '\n';
  });
}

std::string read_path(const std::string& path, FoundPath& found) {
  found = {};
  return read_lines(path, kPoses, [&](const std::string& word, std::istream& in) {
    if (word == "seconds") return static_cast<bool>(in >> found.seconds);
    if (word != "pose") return false;
    FoundPose& p = found.poses.emplace_back();
    return static_cast<bool>(in >> p.coordinates >> p.contact >> p.settled);
  });
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace genu::peers
