#include "genu/store/failure_file.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "genu/core/file_checksum.h"
#include "genu/store/tolerances.h"
namespace genu {
namespace {

using nlohmann::ordered_json;

constexpr int kFailureFormat = 2;  // of the whole, and of what Failure::rest holds (path/fields.h)

std::string to_hex(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out;
  out.reserve(2 * bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out += kDigits[byte >> 4];
    out += kDigits[byte & 15];
  }
  return out;
}

/// Empty where the text is no bytes in hexadecimal digits.
std::optional<std::string> from_hex(const std::string& text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1; };
  if (text.size() % 2 != 0) return std::nullopt;
  std::string out;
  for (std::size_t k = 0; k < text.size(); k += 2) {
    if (digit(text[k]) < 0 || digit(text[k + 1]) < 0) return std::nullopt;
    out += static_cast<char>(16 * digit(text[k]) + digit(text[k + 1]));
  }
  return out;
}

std::string text_of(const ordered_json& j) { return j.dump(1, ' ', false, ordered_json::error_handler_t::replace); }

/// A name that leads out of the folder it is unpacked into is none of ours.
bool is_plain(const std::string& name) {
  constexpr std::size_t kLongestFileName = 200;
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
  return !name.empty() && name.size() <= kLongestFileName && name[0] != '.' && name.find('/') == std::string::npos &&
         name != "scene.toml" && std::none_of(name.begin(), name.end(), control);
}

}  // namespace

std::string to_json(const Failure& f) {
  ordered_json j;
  j["genu_failure"] = kFailureFormat;
  j["genu"] = f.version;
  j["program"] = f.program;
  j["verdict"] = f.verdict;
  j["messages"] = f.messages;
  j["events"] = f.events;
  j["last_accepted_poses"] = f.last_poses;
  j["memory_limit_bytes"] = f.memory_limit;
  j["meshes_are"] = f.meshes_are;
  j["scene"] = f.scene;
  j["meshes"] = ordered_json::array();
  for (const auto& [name, bytes] : f.meshes) j["meshes"].push_back({{"name", name}, {"hex", to_hex(bytes)}});
  j["rest_hex"] = to_hex(f.rest);
  // Not UTF-8 from a file: replaced, and the same again when it is read.
  j = ordered_json::parse(text_of(j));
  const std::string hash = checksum(text_of(j)).xxh128;
  j["hash"] = hash;
  return text_of(j) + "\n";
}

std::optional<Failure> read_failure(const std::string& text, const std::string& file, Diagnostics& out) {
  ordered_json j = ordered_json::parse(text, nullptr, false);
  try {
    if (!j.is_object() || j.value("genu_failure", 0) == 0) {
      out.error(Code::broken_file, file, "is no failure that genu run --save-failure has written");
      return std::nullopt;
    }
    if (j["genu_failure"] != kFailureFormat) {
      out.error(Code::other_version, file, "was written by another version of genu, " + j.value("genu", std::string()));
      return std::nullopt;
    }
    const std::string hash = j.value("hash", std::string());
    j.erase("hash");
    if (hash != checksum(text_of(j)).xxh128) {
      out.error(Code::broken_file, file, "is cut off or has been changed");
      return std::nullopt;
    }
    Failure f;
    f.version = j["genu"];
    f.program = j["program"];
    f.verdict = j["verdict"].get<std::vector<std::string>>();
    f.messages = j["messages"].get<std::vector<std::string>>();
    f.events = j["events"].get<std::vector<std::string>>();
    f.last_poses = j["last_accepted_poses"].get<std::vector<std::string>>();
    f.memory_limit = j["memory_limit_bytes"];
    f.meshes_are = j["meshes_are"];
    f.scene = j["scene"];
    const auto bytes = [&](const ordered_json& hex) {
      auto read = from_hex(hex);
      if (!read) out.error(Code::broken_file, file, "holds bytes that are not in hexadecimal digits");
      return read.value_or(std::string());
    };
    for (const auto& mesh : j["meshes"]) {
      f.meshes.emplace_back(mesh["name"], bytes(mesh["hex"]));
      if (is_plain(f.meshes.back().first)) continue;
      out.error(Code::broken_file, file, "names a mesh outside of its folder");
      return std::nullopt;
    }
    f.rest = bytes(j["rest_hex"]);
    if (f.memory_limit != 0 && f.memory_limit < kMinMemoryLimit)
      out.error(Code::broken_file, file, "has a memory limit too small to run");
    if (out.has_errors()) return std::nullopt;
    return f;
  } catch (const ordered_json::exception&) {
    out.error(Code::broken_file, file, "is no failure that genu run --save-failure has written");
    return std::nullopt;
  }
}

}  // namespace genu
