#include "support/places.h"

namespace genu::test {

std::string source_folder() { return GENU_SOURCE_DIR; }

std::string program() { return GENU_PROGRAM; }

std::string data_default() { return GENU_DATA_DEFAULT; }

}  // namespace genu::test
