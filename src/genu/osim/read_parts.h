// The parts of read_model.cpp: each reads one kind of element into the model.
#pragma once

#include "genu/osim/model.h"
#include "genu/osim/property_reader.h"

namespace genu::osim {

/// A PhysicalOffsetFrame of `owner`, the name of a joint, or inside the body or frame `holder`; each may be empty.
void read_offset_frame(const FileReader& reader, const XmlElement& e, const std::string& owner,
                       const std::string& holder, Model& model);
/// A wrap object of a body or frame; false where it is of another kind than genu has.
bool read_wrap_object(const FileReader& reader, const XmlElement& e, const std::string& body, Model& model);
/// Any joint; an error for a kind that genu does not know.
void read_joint(const FileReader& reader, const XmlElement& e, Model& model);
void read_coupler(const FileReader& reader, const XmlElement& e, Model& model);
/// A member of the ForceSet; nothing happens to what genu does not know.
void read_force(const FileReader& reader, const XmlElement& e, Model& model);
/// A member of the ContactGeometrySet.
void read_contact_geometry(const FileReader& reader, const XmlElement& e, Model& model);
/// The points and wraps of the GeometryPath in `owner`.
GeometryPath read_path(const FileReader& reader, const XmlElement& owner);
/// Every element of the file that a set or a list of it holds, in order.
std::vector<Item> items_of(const XmlElement& model);

}  // namespace genu::osim
