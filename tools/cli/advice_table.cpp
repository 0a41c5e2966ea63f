#include "advice_table.h"

#include <cstddef>
#include <iterator>

namespace genu::cli {
namespace {

struct CodeAdvice {
  Code code;
  const char* what;
};

/// What is to be corrected is where the error points to: a section of the scene, a row of a table, an option.
constexpr const char* kByPlace = "";
constexpr const char* kResultsOfRun = "name the folder that `genu run` wrote, with its results.csv and summary.json";
constexpr const char* kOutputFolder = "name a folder with --out: a new one, or one that holds earlier results of genu";

/// In the order of the codes.
constexpr CodeAdvice kAdvice[] = {
    {Code::unknown_key, kByPlace},
    {Code::missing_key, kByPlace},
    {Code::wrong_form, kByPlace},
    {Code::out_of_range, kByPlace},
    {Code::unknown_name, kByPlace},
    {Code::duplicate, kByPlace},
    {Code::conflict, kByPlace},
    {Code::no_effect, kByPlace},
    {Code::unlikely, kByPlace},
    {Code::not_built, kByPlace},
    {Code::not_toml,
     "correct the file there (TOML, https://toml.io: strings in quotes, tables in [ ]); the rest is read once this is "
     "right"},
    {Code::not_utf8, "save the file as UTF-8 text"},
    {Code::broken_file, kByPlace},
    {Code::no_such_file, "check the name; it counts from the folder you are in, a mesh's name from the scene's folder"},
    {Code::is_folder, "name the file in it"},
    {Code::cannot_read, kByPlace},
    {Code::too_large, kByPlace},
    {Code::cannot_write, "name a place that you can write to, or make room there"},
    {Code::would_overwrite, "name another one, or move away what is there"},
    {Code::would_lose_input, "name another folder with --out"},
    {Code::no_output_folder, kOutputFolder},
    {Code::name_taken, "choose a name that is not taken"},
    {Code::no_scene_name, "give it one: `genu new knee` writes knee/knee.toml"},
    {Code::no_results, kResultsOfRun},
    {Code::results_changed, "run the scene again: its results are incomplete"},
    {Code::other_scene, "name the scene of these results with --scene, or run it again"},
    {Code::other_version, "run the scene again with this version"},
    {Code::cannot_resume, "run the scene again, without --resume"},
    {Code::no_report_page, "run that scene again without --no-report"},
    {Code::page_in_result, "write the page to a folder of its own: --out compared.html"},
    {Code::unknown_column, "the first line of results.csv names its columns"},
    {Code::mesh_unreadable,
     "`genu mesh-check FILE` says what is wrong with a mesh; export it again, or repair it with --repair OUT"},
    {Code::mesh_unusable,
     "`genu mesh-check FILE` says what is wrong with a mesh, and in which unit it seems to be; --repair OUT repairs "
     "it"},
    {Code::mesh_flawed, "`genu mesh-check FILE --repair OUT` repairs a mesh; name the repaired file in the scene"},
    {Code::mesh_repaired, kByPlace},
    {Code::mesh_coordinates, "`genu mesh-check FILE` says what is wrong with a mesh; export it again"},
    {Code::layout, "`genu new --help` says what the meshes must be, and which options name their axes and unit"},
    {Code::meshes_needed, "`genu new --help` shows how meshes are named; `genu mesh` writes meshes of shapes"},
    {Code::no_surface, kByPlace},
    {Code::no_thickness, kByPlace},
    {Code::overlap_at_start,
     "give the joint a `start` where the surfaces are apart, or turn an outward side round with `inside`; "
     "`genu explain joints` and `genu explain surfaces` say how"},
    {Code::not_solved, kByPlace},
    {Code::not_applicable, kByPlace},
    {Code::interrupted, "run it again, and let it finish"},
    {Code::unknown_command, "`genu --help` lists the commands, `genu new NAME` writes a scene to begin with"},
    {Code::usage, kByPlace},
};

constexpr bool follows_the_codes() {
  for (std::size_t k = 0; k < std::size(kAdvice); ++k)
    if (kAdvice[k].code != kAllCodes[k]) return false;
  return true;
}
static_assert(std::size(kAdvice) == kAllCodes.size() && follows_the_codes(), "each code has its advice");

}  // namespace

std::string advice_on_code(Code code) { return kAdvice[static_cast<std::size_t>(code)].what; }

}  // namespace genu::cli
