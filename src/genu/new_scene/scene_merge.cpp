#include "genu/new_scene/scene_merge.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace genu {
namespace {

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

/// Reads TOML as far as where values and comments end.
class ValueScanner {
 public:
  /// Takes one more line. Where its comment begins; its length where it has none.
  std::size_t line(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (!quote_.empty()) {
        if (c == '\\' && quote_.front() == '"')
          ++i;
        else if (text.substr(i).starts_with(quote_)) {
          i += quote_.size() - 1;
          quote_.clear();
        }
      } else if (c == '"' || c == '\'') {
        quote_ = std::string(text.substr(i).starts_with(std::string(3, c)) ? 3 : 1, c);
        i += quote_.size() - 1;
      } else if (c == '#') {
        return i;
      } else if (c == '[' || c == '{') {
        ++depth_;
      } else if (c == ']' || c == '}') {
        --depth_;
      }
    }
    if (quote_.size() == 1) quote_.clear();
    return text.size();
  }
  bool open() const { return depth_ > 0 || !quote_.empty(); }

 private:
  int depth_ = 0;
  std::string quote_;
};

/// A key with its value, or the head of a table, or the end of the file, and the lines of comments before it.
struct Piece {
  std::string table, key;  ///< key: empty of a head
  std::string lead, body;  ///< whole lines
  int line = 0;            ///< of the body
  std::string id() const { return table + "\n" + key; }
  std::string name() const { return key.empty() ? "[" + table + "]" : table.empty() ? key : table + "." + key; }
};

/// What a body says, without comments; and its first comment.
std::string value_of(const std::string& body) {
  ValueScanner scanner;
  std::string out;
  for (std::size_t at = 0; at < body.size();) {
    const std::size_t end = std::min(body.find('\n', at), body.size());
    const std::string_view line = std::string_view(body).substr(at, end - at);
    out += std::string(trim(line.substr(0, scanner.line(line)))) + " ";
    at = end + 1;
  }
  return std::string(trim(out));
}
std::string only_value(const std::string& body) {
  const std::string value = value_of(body);
  return std::string(trim(value.substr(std::min(value.find('=') + 1, value.size()))));
}
std::string comment_of(const std::string& body) {
  ValueScanner scanner;
  const std::string line = body.substr(0, body.find('\n'));
  const std::size_t at = scanner.line(line);
  return at < line.size() ? std::string(trim(std::string_view(line).substr(at))) : "";
}

std::vector<Piece> pieces_of(const std::string& text) {
  std::vector<Piece> out;
  std::map<std::string, int> counts;
  Piece next;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    ++number;
    const std::string line = text.substr(at, end - at);
    const std::string_view words = trim(line);
    at = end;
    if (words.empty() || words.front() == '#') {
      next.lead += line;
      continue;
    }
    next.line = number;
    next.body = line;
    if (words.front() == '[') {
      const std::string_view head = words.substr(0, words.find(']'));
      next.table = trim(head.substr(std::min(head.find_first_not_of('['), head.size())));
      if (words.starts_with("[[")) next.table += "#" + std::to_string(++counts[next.table]);
    } else {
      next.key = trim(words.substr(0, words.find('=')));
      ValueScanner scanner;
      scanner.line(line);
      while (scanner.open() && at < text.size()) {
        end = std::min(text.find('\n', at), text.size() - 1) + 1;
        scanner.line(text.substr(at, end - at));
        next.body += text.substr(at, end - at);
        at = end;
        ++number;
      }
    }
    if (next.body.back() != '\n') next.body += '\n';
    out.push_back(next);
    next = {next.table, {}, {}, {}, 0};
  }
  next.key = "end of the file";
  next.table.clear();
  out.push_back(next);
  return out;
}

using Index = std::map<std::string, const Piece*>;
Index index_of(const std::vector<Piece>& pieces) {
  Index out;
  for (const Piece& p : pieces) out.emplace(p.id(), &p);
  return out;
}
const Piece* find_in(const Index& index, const std::string& id) {
  const auto found = index.find(id);
  return found == index.end() ? nullptr : found->second;
}

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    out.push_back(text.substr(at, end - at));
    at = end;
  }
  return out;
}

/// Comments: where both have changed, the new ones and then the lines that the user has added.
std::string merged_lead(const std::string& written, const std::string& mine, const std::string& fresh) {
  if (mine == written) return fresh;
  if (fresh == written) return mine;
  const std::vector<std::string> old = lines_in(written);
  std::string out = fresh;
  for (const std::string& line : lines_in(mine))
    if (!trim(line).empty() && std::find(old.begin(), old.end(), line) == old.end()) out += line;
  return out;
}

class Merge {
 public:
  Merge(const std::string& written, const std::string& mine, const std::string& fresh)
      : written_(pieces_of(written)), mine_(pieces_of(mine)), fresh_(pieces_of(fresh)) {
    old_ = index_of(written_);
    own_ = index_of(mine_);
    new_ = index_of(fresh_);
  }

  MergedScene result() {
    keep_tables_that_went();
    for (const Piece& p : fresh_)
      if (!taken_out(p)) merged_.push_back(both(p));
    add_mine();
    for (const Piece& p : merged_) out_.text += p.lead + p.body;
    return std::move(out_);
  }

 private:
  bool is_changed(const Piece& mine) const {
    const Piece* old = find_in(old_, mine.id());
    return !old || value_of(old->body) != value_of(mine.body);
  }

  /// Tables that are not written any more, and that the user has worked on: they stay whole.
  void keep_tables_that_went() {
    for (const Piece& p : mine_)
      if (!p.key.empty() && find_in(old_, p.table + "\n") && !find_in(new_, p.table + "\n") && is_changed(p) &&
          whole_.insert(p.table).second)
        out_.conflicts.push_back({{p.line, 1}, p.name(), only_value(p.body), ""});
  }

  bool taken_out(const Piece& fresh) {
    const bool out = (find_in(old_, fresh.id()) && !find_in(own_, fresh.id())) ||
                     (find_in(old_, fresh.table + "\n") && !find_in(own_, fresh.table + "\n"));
    if (out && fresh.key.empty()) ++out_.kept;
    if (out && !fresh.key.empty() && find_in(own_, fresh.table + "\n")) ++out_.kept;
    return out;
  }

  Piece both(const Piece& fresh) {
    const Piece *old = find_in(old_, fresh.id()), *mine = find_in(own_, fresh.id());
    if (!mine) return fresh;
    Piece out = fresh;
    out.lead = merged_lead(old ? old->lead : "", mine->lead, fresh.lead);
    const std::string ours = value_of(mine->body), theirs = value_of(fresh.body),
                      before = old ? value_of(old->body) : "";
    if (ours != before) {
      out.body = mine->body;
      if (ours == theirs) return out;
      ++out_.kept;
      if (theirs != before)
        out_.conflicts.push_back({{mine->line, 1}, mine->name(), only_value(mine->body), only_value(fresh.body)});
    } else if (mine->body != (old ? old->body : "")) {  // a comment alone
      const std::string comment = comment_of(mine->body);
      out.body = theirs == before ? mine->body : theirs + (comment.empty() ? "" : "   " + comment) + "\n";
    }
    return out;
  }

  /// What the user has added, behind what it stands behind there.
  void add_mine() {
    std::string behind;
    for (const Piece& p : mine_) {
      const bool is_there =
          std::any_of(merged_.begin(), merged_.end(), [&](const Piece& m) { return m.id() == p.id(); });
      const bool added = !find_in(old_, p.id());
      if (!is_there && (added || whole_.contains(p.table))) {
        const auto at = std::find_if(merged_.begin(), merged_.end(), [&](const Piece& m) { return m.id() == behind; });
        merged_.insert(at == merged_.end() ? merged_.end() - 1 : at + 1, p);
        if (p.key.empty() || find_in(old_, p.table + "\n")) ++out_.kept;
      }
      behind = is_there || added || whole_.contains(p.table) ? p.id() : behind;
    }
  }

  std::vector<Piece> written_, mine_, fresh_, merged_;
  Index old_, own_, new_;
  std::set<std::string> whole_;
  MergedScene out_;
};

}  // namespace

MergedScene merge_scenes(const std::string& written, const std::string& mine, const std::string& fresh) {
  return Merge(written, mine, fresh).result();
}

}  // namespace genu
