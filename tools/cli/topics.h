// What `genu explain TOPIC` finds in the pages: sections by their headings, rows of tables by the code words in
// their first cell (keys, columns, statuses, events, options).
#pragma once

#include <string>
#include <vector>

#include "help_pages.h"

namespace genu::cli {

/// A heading and what is under it, down to the next heading of its level or above.
struct Topic {
  std::string page, title, text;
  int level = 1;     ///< of the heading
  std::string name;  ///< the title in small letters with - between words, without articles: "whole-scene"
};

/// A row of a table.
struct TopicRow {
  std::vector<std::string> names;  ///< codes of its first cell, such as "stiffness" or "CONTACT.force_N"
  std::vector<std::string> heads, cells;
  std::string section, page;  ///< the place of the row
};

struct Topics {
  std::vector<Topic> sections;
  std::vector<TopicRow> rows;
};

Topics topics_of(const std::vector<HelpPage>& pages);

/// The explanation of a word as text for a terminal; empty for an unknown word. Sections by name (also in the
/// singular), whole pages, rows by a name, "SECTION.KEY" or a column of results.csv with its objects' own names.
std::string explain_topic(const Topics& topics, const std::string& word);

/// Sections whose text has all words of `text`, in any case, as "page: title" with a line that has the first: those
/// with the most of them first, at most `most`. Of a column of results that none has, the part after its object is
/// searched: force_N of ACL.force_N. Empty where there is none.
std::string sections_with(const Topics& topics, const std::string& text, std::size_t most = 8);

/// Every word that explain_topic() knows, but for columns with objects' names in them.
std::vector<std::string> known_topics(const Topics& topics);

/// The list of topics, to begin with.
std::string topic_list(const Topics& topics);

/// Markdown as plain text: tables as paragraphs, links as their words.
std::string plain_text_of(const std::string& markdown);

}  // namespace genu::cli
