#include "genu/core/program_hash.h"

#include <link.h>

#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "genu/core/file_checksum.h"

namespace genu {
namespace {

/// Empty where the file cannot be read.
std::string file_hash(const std::string& path) {
  const auto sum = file_checksum(path);
  return sum ? sum->xxh128 : std::string();
}

/// The linker's hash of what it linked, from the notes of a loaded file; empty where it has none.
std::string build_id(const dl_phdr_info& info) {
  for (int k = 0; k < info.dlpi_phnum; ++k) {
    const ElfW(Phdr)& part = info.dlpi_phdr[k];
    if (part.p_type != PT_NOTE || part.p_align > 4) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): addresses in a loaded file are numbers
    const std::string notes(reinterpret_cast<const char*>(info.dlpi_addr + part.p_vaddr), part.p_memsz);
    for (std::size_t place = 0; place + sizeof(ElfW(Nhdr)) <= notes.size();) {
      ElfW(Nhdr) head;
      std::memcpy(&head, notes.data() + place, sizeof head);
      const std::size_t name = place + sizeof head, content = name + (head.n_namesz + 3) / 4 * 4;
      if (head.n_type == NT_GNU_BUILD_ID && content <= notes.size() && notes.compare(name, 4, "GNU", 4) == 0)
        return notes.substr(content, head.n_descsz);
      place = content + (head.n_descsz + 3) / 4 * 4;
    }
  }
  return {};
}

int add_library(dl_phdr_info* info, std::size_t, void* out) {
  const std::string name = info->dlpi_name, id = build_id(*info);
  static_cast<std::vector<std::string>*>(out)->push_back(!id.empty()    ? checksum(id).xxh128
                                                         : name.empty() ? file_hash("/proc/self/exe")
                                                                        : file_hash(name));
  return 0;
}

/// The program and what it is linked with, as it starts: libraries may load others later, sooner or not at all.
const std::vector<std::string> kLoaded = [] {
  std::vector<std::string> hashes;
  dl_iterate_phdr(add_library, &hashes);
  return hashes;
}();

}  // namespace

std::string program_hash() {
  std::string all;
  for (const std::string& hash : kLoaded) all += hash;
#if defined(__x86_64__)
  all += fmt::format("{}{}{}", __builtin_cpu_supports("fma") != 0, __builtin_cpu_supports("avx2") != 0,
                     __builtin_cpu_supports("avx512f") != 0);
#endif
  return checksum(all).xxh128;
}

}  // namespace genu
