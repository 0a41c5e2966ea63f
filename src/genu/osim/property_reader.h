// Properties of one element: numbers, vectors, words and flags by their tags. What is missing is looked for in the
// model's <defaults>, then has the value that OpenSim gives it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/pose.h"
#include "genu/osim/function.h"
#include "genu/osim/xml_tree.h"

namespace genu::osim {

/// What all readers of a file share.
struct FileReader {
  const std::string& file;
  const XmlElement* defaults;  ///< <defaults> of the model, or null
  Diagnostics& out;
};

class PropertyReader {
 public:
  PropertyReader(const FileReader& reader, const XmlElement& element) : reader_(reader), element_(element) {}

  double number(const char* tag, double otherwise) const;
  /// An error where it is missing.
  double required(const char* tag) const;
  /// An error where it is not above 0.
  double positive(const char* tag, std::optional<double> otherwise = {}) const;
  Vec3 vector(const char* tag, const Vec3& otherwise) const;
  std::vector<double> numbers(const char* tag) const;
  std::string word(const char* tag, const std::string& otherwise = {}) const;
  bool flag(const char* tag, bool otherwise) const;
  /// A socket or, in files of early versions of OpenSim 4, a name in its place; an error where there is none.
  std::string socket(const char* tag) const;
  /// The coordinate that a socket says or, in older files of OpenSim 4, a name in its place; `prefix` is "" or "x_".
  std::string coordinate(const std::string& prefix = {}) const;
  SourceLocation where(const char* tag) const;

  /// The function inside `holder`, an element with one child that is a function; a constant 0 with an error in the
  /// diagnostics where it is none that can be read.
  Function function(const XmlElement& holder) const;

  /// X of a rotation by body-fixed angles about x, y, z and a translation.
  Pose placement(const char* rotation, const char* translation) const;

  void refuse(Code code, const SourceLocation& where, const std::string& key, const std::string& found,
              const std::string& rule) const;
  const XmlElement& element() const { return element_; }

 private:
  const XmlElement* find(const char* tag) const;
  std::string key(const std::string& tag) const;
  std::vector<double> numbers_of(const XmlElement& e) const;
  Function checked(Function f, const XmlElement& e) const;
  void read_points(const XmlElement& e, Function& f) const;

  const FileReader& reader_;
  const XmlElement& element_;
};

/// R = Rx Ry Rz: rotations about the moving axes.
Mat3 body_fixed_xyz(const Vec3& angles);

}  // namespace genu::osim
