// Tables of the rooms below as those of the API. Not installed.
#pragma once

#include <memory>

#include "genu/api/table.h"
#include "genu/results/result_table.h"

namespace genu::api {

Table table_of(ResultTable table);
/// Of a table that others hold too.
Table table_of(std::shared_ptr<const ResultTable> table);

}  // namespace genu::api
