// All public headers but those in onset/compat/.
#pragma once

#include <onset/active_set.hpp>
#include <onset/candidates.hpp>
#include <onset/check.hpp>
#include <onset/close_pairs.hpp>
#include <onset/constraints.hpp>
#include <onset/intersections.hpp>
#include <onset/line_search.hpp>
#include <onset/match.hpp>
#include <onset/mesh.hpp>
#include <onset/options.hpp>
#include <onset/query.hpp>
#include <onset/result.hpp>
#include <onset/safe_distance.hpp>
#include <onset/step_size.hpp>
#include <onset/tetrahedra.hpp>
#include <onset/trajectory.hpp>
#include <onset/truncate_step.hpp>
#include <onset/vertex_map.hpp>
#include <onset/views.hpp>
