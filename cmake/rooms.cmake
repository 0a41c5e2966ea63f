# Headers nearly every file includes, read once for all: a third of the time to build. Each file still includes what it
# uses; -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(genu_common_headers <algorithm> <array> <cmath> <filesystem> <functional> <limits> <map> <memory> <numbers>
    <optional> <string> <vector> <Eigen/Core> <Eigen/Geometry> <Eigen/LU>)

# genu_position_independent(TARGET): its objects may become part of libgenu.so (cmake/install.cmake). Calls inside a file
# stay as direct as they are in a program. Not with the sanitizers: fuzzing programs share the headers read once for all.
function(genu_position_independent target)
  if(GENU_SANITIZE)
    return()
  endif()
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
endfunction()

# Which rooms each room may include, besides itself. Each names rooms above it alone, so that there can be no cycle. A
# test (tests/style) holds the includes to this list.
set(genu_rooms core mesh atlas law scene osim surface wrap mesh_files mesh_care judge shape_fit contact model equilibrium path motion
    results assemble landmarks store appraise study new_scene calibrate sweep api)
set(genu_core_uses)
set(genu_mesh_uses core)
set(genu_atlas_uses core mesh)
set(genu_law_uses core)
set(genu_scene_uses core law)
set(genu_osim_uses core scene)
set(genu_surface_uses core mesh)
set(genu_mesh_files_uses core mesh)
set(genu_mesh_care_uses core mesh surface mesh_files)
set(genu_judge_uses core scene mesh mesh_files)
set(genu_shape_fit_uses core mesh surface mesh_care)
set(genu_wrap_uses core mesh surface)
set(genu_contact_uses core mesh surface)
set(genu_model_uses core law scene mesh surface wrap contact)
set(genu_equilibrium_uses core contact model)
set(genu_path_uses core contact model equilibrium)
set(genu_motion_uses core contact model equilibrium path)
set(genu_results_uses core scene model equilibrium path motion)
set(genu_assemble_uses core law scene mesh surface mesh_files mesh_care shape_fit contact model path motion results)
set(genu_landmarks_uses core scene mesh_files assemble)
set(genu_store_uses core scene mesh surface mesh_files path motion results assemble)
set(genu_appraise_uses core scene contact model equilibrium path motion results assemble)
set(genu_study_uses core atlas law scene osim mesh surface mesh_files mesh_care shape_fit contact model equilibrium path motion
    results assemble landmarks store appraise)
set(genu_new_scene_uses core atlas scene mesh mesh_files model equilibrium results assemble landmarks store study)
set(genu_calibrate_uses core law scene mesh_files contact model equilibrium path motion results assemble study)
set(genu_sweep_uses core scene surface model results assemble store appraise study)
set(genu_api_uses core law scene mesh mesh_files mesh_care model motion results assemble store study new_scene)

# genu_room(NAME [LIBRARIES ...] [PRIVATE ...]): the static library genu_NAME from src/genu/NAME/*.cpp. LIBRARIES are
# part of its public face; PRIVATE libraries are seen by its .cpp files alone.
function(genu_room name)
  cmake_parse_arguments(arg "" "" "LIBRARIES;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/genu/${name}/*.cpp)
  add_library(genu_${name} STATIC ${sources})
  target_include_directories(genu_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  genu_position_independent(genu_${name})
  list(TRANSFORM genu_${name}_uses PREPEND genu_ OUTPUT_VARIABLE uses)
  target_link_libraries(genu_${name} PUBLIC ${uses} ${arg_LIBRARIES} PRIVATE genu_options)
  if(name STREQUAL "core")
    target_precompile_headers(genu_core PRIVATE ${genu_common_headers} <fmt/format.h>)
  else()
    target_precompile_headers(genu_${name} REUSE_FROM genu_core)
  endif()
  # Third-party headers are not ours to keep free of warnings.
  foreach(library ${arg_PRIVATE})
    target_link_libraries(genu_${name} PRIVATE ${library})
  endforeach()
endfunction()
