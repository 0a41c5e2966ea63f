// The parts of read_model.cpp: each reads one kind of element into the model.
#pragma once

#include "genu/osim/model.h"
#include "genu/osim/property_reader.h"

namespace genu::osim {

/// The PhysicalOffsetFrames in the list `tag` of `e`, whose path is `owner`: "/jointset/knee_r"; empty: the model.
void read_offset_frames(const FileReader& reader, const XmlElement& e, const char* tag, const std::string& owner,
                        Model& model);
/// A wrap object of the body or frame at the path `frame`; false where it is of another kind than genu has.
bool read_wrap_object(const FileReader& reader, const XmlElement& e, const std::string& frame, Model& model);
/// Any joint; an error for a kind that genu does not know.
void read_joint(const FileReader& reader, const XmlElement& e, Model& model);
void read_coupler(const FileReader& reader, const XmlElement& e, Model& model);
/// A member of the ForceSet; nothing happens to what genu does not know.
void read_force(const FileReader& reader, const XmlElement& e, Model& model);
/// A member of the ContactGeometrySet.
void read_contact_geometry(const FileReader& reader, const XmlElement& e, Model& model);
/// The points and wraps of the GeometryPath in `owner`, a member of the ForceSet.
GeometryPath read_path(const FileReader& reader, const XmlElement& owner, const Model& model);
/// Every element of the file that a set or a list of it holds, in order.
std::vector<Item> items_of(const XmlElement& model);

}  // namespace genu::osim
