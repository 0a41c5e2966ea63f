#include "topics.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>

#include "genu/scene/words.h"
#include "topic_text.h"

namespace genu::cli {
namespace {

std::string slug(const std::string& title) {
  std::string out;
  for (const char c : plain_words(title)) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0)
      out += static_cast<char>(std::tolower(u));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out.rfind("a-", 0) == 0 ? out.substr(2) : out;
}

/// bodies, joints -> body, joint
std::string singular(const std::string& word) {
  if (word.ends_with("ies")) return word.substr(0, word.size() - 3) + "y";
  return word.ends_with("s") && !word.ends_with("ss") && !word.ends_with("ics") ? word.substr(0, word.size() - 1)
                                                                                : word;
}

bool names(const std::string& topic, const std::string& word) { return word == topic || word == singular(topic); }

/// The codes of a table's first cell, without the quotes of values.
std::vector<std::string> codes_of(const std::string& cell) {
  std::vector<std::string> codes;
  for (std::size_t at = cell.find('`'); at != std::string::npos; at = cell.find('`', at)) {
    const std::size_t end = cell.find('`', at + 1);
    if (end == std::string::npos) break;
    std::string code = cell.substr(at + 1, end - at - 1);
    if (code.size() > 2 && code.front() == '"' && code.back() == '"') code = code.substr(1, code.size() - 2);
    // "JOINT.x_N", "_Nm", ".y_N": what is left out is that of the first.
    if (!codes.empty() && (code.front() == '_' || code.front() == '.'))
      if (const std::size_t stem = codes.front().rfind(code.front()); stem != std::string::npos)
        code = codes.front().substr(0, stem) + code;
    codes.push_back(code);
    at = end + 1;
  }
  return codes;
}

/// "stable, unstable, neutral": what a glossary explains in one row.
std::vector<std::string> terms_of(const std::string& cell) {
  std::vector<std::string> terms;
  std::istringstream parts(cell);
  for (std::string term; std::getline(parts, term, ',');) terms.push_back(slug(term));
  return terms;
}

int heading_level(const std::string& line) {
  const std::size_t level = line.find_first_not_of('#');
  return level != std::string::npos && level > 0 && line[level] == ' ' ? static_cast<int>(level) : 0;
}

void add_rows(const Topic& section, std::vector<TopicRow>& rows) {
  std::istringstream lines(section.text);
  std::vector<std::string> heads;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) code = !code;
    if (code || line.empty()) heads.clear();
    if (code || line.rfind('|', 0) != 0 || is_rule_line(line)) continue;
    if (heads.empty()) {
      heads = cells_of(line);
      continue;
    }
    TopicRow row{{}, heads, cells_of(line), section.title, section.page};
    if (!row.cells.empty()) row.names = codes_of(row.cells.front());
    if (row.names.empty() && !row.cells.empty() && section.page == "glossary") row.names = terms_of(row.cells.front());
    for (std::size_t c = 1; c < row.cells.size() && c < heads.size(); ++c)
      if (heads[c] == "keys")
        for (const std::string& key : codes_of(row.cells[c])) row.names.push_back(key);
    for (const std::string& whole : codes_of(heads.front())) row.names.push_back(whole);  // "key of `solid`"
    if (!row.names.empty()) rows.push_back(std::move(row));
  }
}

/// "CONTACT.force_N" as a pattern for columns of objects with names: "*.force_N".
std::string column_pattern(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size();) {
    std::size_t end = i;
    while (end < name.size() && std::isupper(static_cast<unsigned char>(name[end])) != 0) ++end;
    if (end - i >= 4) {
      out += '*';
      i = end;
    } else {
      out += name[i++];
    }
  }
  return out;
}

bool has_name(const TopicRow& row, const std::string& word) {
  return std::any_of(row.names.begin(), row.names.end(), [&](const std::string& name) {
    if (name == word || name == "." + word || name.ends_with("." + word)) return true;
    const std::string pattern = column_pattern(name);
    return pattern != name && pattern != "*" && word.find('.') != std::string::npos && matches(pattern, word);
  });
}

const Topic* topic_of(const Topics& topics, const std::string& word) {
  for (const Topic& t : topics.sections)
    if (names(t.name, word)) return &t;
  return nullptr;
}

std::string rows_text(const std::vector<const TopicRow*>& rows) {
  std::string out, section;
  for (const TopicRow* row : rows) {
    if (row->section != section) out += (out.empty() ? "" : "\n") + plain_words(row->section) + "\n";
    section = row->section;
    out += row_text(row->heads, row->cells);
  }
  return out;
}

}  // namespace

Topics topics_of(const std::vector<HelpPage>& pages) {
  Topics out;
  for (const HelpPage& page : pages) {
    std::vector<std::string> lines;
    std::istringstream in(page.text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    bool code = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].rfind("```", 0) == 0) code = !code;
      const int level = code ? 0 : heading_level(lines[i]);
      if (level == 0) continue;
      Topic topic{page.name, plain_words(lines[i].substr(static_cast<std::size_t>(level) + 1)), {}, level, {}};
      topic.name = level == 1 ? page.name : slug(topic.title);
      Topic own = topic;  // down to the next heading of any level: its rows
      bool inside = false, below = false;
      for (std::size_t j = i + 1; j < lines.size(); ++j) {
        if (lines[j].rfind("```", 0) == 0) inside = !inside;
        const int next = inside ? 0 : heading_level(lines[j]);
        if (next > 0 && next <= level) break;
        below = below || next > 0;
        topic.text += lines[j] + "\n";
        if (!below) own.text += lines[j] + "\n";
      }
      add_rows(own, out.rows);
      out.sections.push_back(std::move(topic));
    }
  }
  return out;
}

std::string explain_topic(const Topics& topics, const std::string& asked) {
  std::string word = asked;
  std::replace(word.begin(), word.end(), ' ', '-');
  if (const Topic* t = topic_of(topics, word)) return t->title + "\n" + plain_text_of(t->text);
  std::vector<const TopicRow*> found;
  // ligament.ACL.stiffness: the key, in its own section.
  const std::size_t dot = word.find('.');
  if (dot != std::string::npos)
    for (const TopicRow& row : topics.rows)
      if (names(slug(row.section), word.substr(0, dot)) && has_name(row, word.substr(word.rfind('.') + 1)))
        found.push_back(&row);
  if (found.empty())
    for (const TopicRow& row : topics.rows)
      if (has_name(row, word)) found.push_back(&row);
  if (found.empty() && dot != std::string::npos && topic_of(topics, word.substr(0, dot)) != nullptr)
    return explain_topic(topics, word.substr(word.rfind('.') + 1));
  return rows_text(found);
}

namespace {

std::string small(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) ++count;
  return count;
}

/// The words of a page without its examples: lines between fences or behind four blanks.
std::string without_examples(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) code = !code;
    if (!code && !line.starts_with("    ")) out += line + "\n";
  }
  return out;
}

/// The first line that has the word, as plain words and not longer than a terminal.
std::string line_with(const Topic& topic, const std::string& word) {
  std::istringstream lines(without_examples(topic.text));
  constexpr std::size_t kLongest = 100;
  for (std::string line; std::getline(lines, line);) {
    if (small(line).find(word) == std::string::npos) continue;
    std::string plain = plain_words(line);
    for (char& c : plain)
      if (c == '|') c = ' ';
    plain.erase(0, plain.find_first_not_of(" -"));
    const std::size_t at = small(plain).find(word);
    if (at != std::string::npos && at > kLongest / 2)
      plain = "... " + plain.substr(plain.find(' ', at - kLongest / 2) + 1);
    if (plain.size() > kLongest) plain = plain.substr(0, plain.rfind(' ', kLongest)) + " ...";
    return plain;
  }
  return topic.title;
}

/// In small letters.
std::vector<std::string> searched_words(const std::string& text) {
  std::istringstream parts(small(text));
  std::vector<std::string> words;
  for (std::string word; parts >> word;) words.push_back(word);
  return words;
}

}  // namespace

std::string sections_with(const Topics& topics, const std::string& text, std::size_t most) {
  std::vector<std::string> words = searched_words(text);
  std::vector<std::pair<std::size_t, const Topic*>> found;
  const auto search = [&] {
    for (const Topic& topic : topics.sections) {
      const bool inner = std::any_of(topics.sections.begin(), topics.sections.end(), [&](const Topic& other) {
        return &other != &topic && other.page == topic.page && other.level > topic.level &&
               topic.text.find("\n" + std::string(static_cast<std::size_t>(other.level), '#') + " ") !=
                   std::string::npos &&
               topic.text.find(other.text) != std::string::npos &&
               small(without_examples(other.text)).find(words.front()) != std::string::npos;
      });
      if (inner) continue;  // the section below it is the closer place
      const std::string all = small(topic.title + "\n" + without_examples(topic.text));
      std::size_t count = 0;
      for (const std::string& word : words) {
        const std::size_t here = count_of(all, word);
        if (here == 0) {
          count = 0;
          break;
        }
        count += here;
      }
      if (count > 0) found.emplace_back(count, &topic);
    }
  };
  if (words.empty()) return {};
  search();
  if (const std::size_t dot = words.front().rfind('.'); found.empty() && dot != std::string::npos) {
    words.front() = words.front().substr(dot + 1);
    if (!words.front().empty()) search();
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string out;
  for (std::size_t k = 0; k < std::min(most, found.size()); ++k)
    out += fmt::format("  {}: {}\n      {}\n", found[k].second->page, found[k].second->title,
                       line_with(*found[k].second, words.front()));
  if (found.size() > most) out += fmt::format("  and {} more sections\n", found.size() - most);
  return out;
}

std::vector<std::string> known_topics(const Topics& topics) {
  std::vector<std::string> out;
  for (const Topic& t : topics.sections)
    for (const std::string& name : {t.name, singular(t.name)}) out.push_back(name);
  for (const TopicRow& row : topics.rows)
    for (const std::string& name : row.names) {
      out.push_back(name);
      if (const std::size_t dot = name.rfind('.'); dot != std::string::npos) out.push_back(name.substr(dot + 1));
    }
  return out;
}

std::string topic_list(const Topics& topics) {
  std::string sections, pages;
  for (const Topic& t : topics.sections) {
    if (t.level == 1 && t.page != "scene-reference") pages += fmt::format("  {:<22} {}\n", t.name, t.title);
    if (t.level > 1 && t.page == "scene-reference") sections += fmt::format("  {:<22} {}\n", t.name, t.title);
  }
  return "genu explain TOPIC says what a word means:\n\n"
         "a section of a scene, or of what a run writes\n" +
         sections + "\na page\n" + pages +
         "\na key (stiffness, contact.model), a column of results.csv (knee.flexion.reaction_Nm, area_mm2),\n"
         "a status (over_edge), an event (snaps), a term (gap)\n\n"
         "genu explain SCENE says what system a scene asks for.\n";
}

}  // namespace genu::cli
