#include "genu/sweep/missing_shards.h"

#include <filesystem>

#include "genu/sweep/table_file.h"

namespace genu {

bool shard_is_whole(const std::string& folder, const SweepRecord& record, ShardId id, const EachRow& each,
                    Diagnostics& out) {
  if (record.tables && !check_tables(
                           folder, record, id, [](std::string_view) {}, out))
    return false;
  return read_shard(folder, record, id, each, out).has_value();
}

std::vector<std::uint64_t> missing_shards(const std::string& folder, const SweepRecord& record, Diagnostics& out) {
  std::vector<std::uint64_t> missing;
  std::error_code ignored;
  for (std::uint64_t k = 1; k <= record.shards; ++k) {
    const ShardId id{k, record.shards};
    Diagnostics broken;
    if (std::filesystem::exists(shard_path(folder, id), ignored) &&
        shard_is_whole(
            folder, record, id, [](std::string_view) {}, broken))
      continue;
    missing.push_back(k);
    for (const Diagnostic& d : broken.items()) out.warning(d.code, d.file, d.rule);
  }
  return missing;
}

}  // namespace genu
