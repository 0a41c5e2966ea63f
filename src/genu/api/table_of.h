// Tables of the rooms below as those of the API. Not installed.
#pragma once

#include "genu/api/table.h"
#include "genu/results/result_table.h"

namespace genu::api {

Table table_of(ResultTable table);

}  // namespace genu::api
