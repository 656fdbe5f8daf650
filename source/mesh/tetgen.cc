// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tetgen.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/checked_surface.h"
#include "tetradapt/geometry/surface_intersections.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/kept_places.h"
#include "tetradapt/mesh/tetgen_demand.h"
#include "tetradapt/mesh/tetgen_frame.h"
#include "tetradapt/mesh/tetgen_process.h"
#include "tetradapt/mesh/tetgen_request.h"
#include "tetradapt/mesh/tetgen_result.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using core::InputError;
    using core::NumericalError;

    constexpr double smallest_radius_edge_ratio = 1.1;
    constexpr double largest_dihedral_angle     = 20.;

    double
    seconds_since(std::chrono::steady_clock::time_point start)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    template <typename... Parts>
    std::string
    text(const Parts &...parts)
    {
      std::ostringstream stream;
      (stream << ... << parts);
      return stream.str();
    }

    unsigned long
    count_oversized(const TetMesh &mesh, double max_volume)
    {
      unsigned long count = 0;
      if (max_volume > 0.)
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          if (cell_volume(mesh, cell) > max_volume * (1. + 1e-9))
            ++count;
      return count;
    }

    /** What the volume mesh of a boundary has to consist of. */
    MeshTotals
    expected_totals(const geometry::CheckedSurface &surface, const PiecewiseLinearComplex &plc)
    {
      MeshTotals totals;
      totals.volume = surface.volume;
      totals.area   = surface.area;
      totals.patches.resize(plc.patches.size());
      const auto &p = surface.mesh.points;
      for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i)
        {
          const auto &t     = surface.mesh.triangles[i];
          auto       &entry = totals.patches[surface.mesh.ids[i]];
          ++entry.n_faces;
          entry.area += 0.5 * dealii::cross_product_3d(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).norm();
        }
      for (std::size_t i = 0; i < plc.patches.size(); ++i)
        totals.patches[i].patch = plc.patches[i];
      return totals;
    }

    /** TetGen crashes on a region's point that lies outside, and deals the cells of
     * a part with two points out at random. Where inner facets divide parts, it is
     * up to who made them to give one point each. */
    void
    check_seeds(const geometry::CheckedSurface &surface, const PiecewiseLinearComplex &plc)
    {
      const bool divided = std::any_of(plc.facets.begin(), plc.facets.end(), [](const auto &facet) {
        return facet.patch == PiecewiseLinearComplex::inner;
      });
      if (!divided && !plc.regions.empty() && plc.regions.size() != surface.n_components)
        throw InputError(text("There are ",
                              plc.regions.size(),
                              " regions for the ",
                              surface.n_components,
                              " separate parts of ",
                              plc.name,
                              ". Give each part one point."));
      for (const auto &region : plc.regions)
        if (!geometry::encloses(surface.mesh, region.seed))
          throw InputError(text("The point ",
                                to_string(region.seed),
                                " of region ",
                                region.id,
                                " does not lie inside ",
                                plc.name,
                                ". Move it."));
    }

    void
    check_regions(const MeshTotals &totals, const PiecewiseLinearComplex &plc)
    {
      if (plc.regions.empty())
        return;
      for (const auto &[id, entry] : totals.regions)
        if (std::none_of(plc.regions.begin(), plc.regions.end(), [id = id](const auto &region) {
              return region.id == id;
            }))
          throw InputError(text("A part of ",
                                plc.name,
                                " of volume ",
                                entry.volume,
                                " contains the point of no region. Give each part a point."));
    }
  } // namespace

  Tetgen::Tetgen(const scene::TetgenParameters &parameters) : parameters(parameters)
  {
    const auto refuse = [](const std::string &message) { throw InputError(message); };
    if (!(parameters.radius_edge_ratio >= smallest_radius_edge_ratio))
      refuse(text("TetGen/Radius-edge ratio is ",
                  parameters.radius_edge_ratio,
                  "; below ",
                  smallest_radius_edge_ratio,
                  " TetGen does not finish."));
    if (!(parameters.dihedral_angle >= 0. && parameters.dihedral_angle <= largest_dihedral_angle))
      refuse(text("TetGen/Minimum dihedral angle is ",
                  parameters.dihedral_angle,
                  "; it must be between 0 and ",
                  largest_dihedral_angle,
                  " degrees: above, TetGen does not finish."));
    if (!std::isfinite(parameters.radius_edge_ratio) || parameters.radius_edge_ratio > 1e3)
      refuse("TetGen/Radius-edge ratio must be at most 1000.");
    if (parameters.optimisation_level > 10 || parameters.optimisation_scheme > 7)
      refuse("TetGen/Optimisation level must be 0 to 10, TetGen/Optimisation scheme 0 to 7.");
    if (parameters.steiner_points > 100'000'000)
      refuse("TetGen/Steiner points must be at most 100000000.");
    if (!(parameters.time_limit > 0.) || !(parameters.memory_limit > 0.))
      refuse("TetGen/Time limit and TetGen/Memory limit must be positive.");
  }

  TetMesh
  Tetgen::mesh(const PiecewiseLinearComplex &plc, const Sizing &sizing, TetgenReport *report) const
  {
    const auto start = std::chrono::steady_clock::now();
    check_node_sizes(sizing.node_sizes, plc.points, plc.name);
    if (!std::isfinite(sizing.max_volume))
      throw InputError("The bound on the volume of tetrahedra must be a finite number.");
    const auto surface = geometry::check_surface(triangulate(plc), plc.name);
    check_seeds(surface, plc);
    check_thickness(surface.volume, surface.area, parameters.time_limit, plc.name);
    if (sizing.max_volume > 0.)
      check_number_of_cells(expected_cells(surface.volume, sizing.max_volume),
                            parameters.memory_limit,
                            plc.name);

    TetgenRequest     request = make_request(plc, sizing);
    const TetgenFrame frame(request.points);
    frame.enter(request);
    request.switches = make_switches(parameters,
                                     request,
                                     frame.volume(sizing.max_volume),
                                     parameters.steiner_points);
    TetgenReply reply
      = run_tetgen(request, {parameters.time_limit, parameters.memory_limit}, plc.name);
    frame.leave(reply);

    TetMesh mesh = mesh_from_reply(reply, plc.patches, plc.name);
    mesh.kept    = plc.kept;
    check_kept_places(mesh);
    MeshTotals       before = expected_totals(surface, plc);
    const MeshTotals after  = mesh_totals(mesh);
    check_regions(after, plc);
    before.regions     = after.regions;
    const double drift = check_kept(before, after, plc.volume_tolerance, plc.name);
    if (report != nullptr)
      {
        report->called   = true;
        report->switches = request.switches;
        report->new_points
          = mesh.n_points() - std::min<std::size_t>(mesh.n_points(), plc.points.size());
        report->cap_reached
          = parameters.steiner_points >= 0
            && report->new_points >= static_cast<unsigned long>(parameters.steiner_points);
        report->oversized_cells = count_oversized(mesh, sizing.max_volume);
        report->volume_drift    = drift;
        report->seconds         = seconds_since(start);
      }
    return mesh;
  }

  TetMesh
  Tetgen::refine(const TetMesh &mesh, const Sizing &sizing, TetgenReport *report) const
  {
    const auto        start = std::chrono::steady_clock::now();
    const std::string what  = "the refined mesh";
    check_sizing(mesh, sizing, what);
    const SizeDemand demand = assess(mesh, sizing);
    if (report != nullptr)
      *report = TetgenReport();
    if (demand.nothing_new || parameters.steiner_points == 0)
      {
        if (report != nullptr)
          report->cap_reached = !demand.nothing_new;
        return mesh;
      }
    check_number_of_cells(demand.n_cells, parameters.memory_limit, what);

    unsigned long n_inserted = 0;
    TetgenRequest request    = make_request(mesh, sizing, n_inserted);
    const long    cap        = parameters.steiner_points < 0
                                 ? -1
                                 : parameters.steiner_points + static_cast<long>(n_inserted);
    request.switches         = make_switches(parameters, request, 0., cap);
    const TetgenFrame frame(request.points);
    frame.enter(request);
    TetgenReply reply = run_tetgen(request, {parameters.time_limit, parameters.memory_limit}, what);
    if (reply.points.size() < request.points.size()
        || !std::equal(request.points.begin(), request.points.end(), reply.points.begin()))
      throw NumericalError("TetGen did not keep the points of the mesh that it refined.");
    frame.leave(reply);

    TetMesh refined      = mesh_from_reply(reply, mesh.patches, what);
    refined.region_names = mesh.region_names;
    refined.kept         = mesh.kept;
    check_kept_places(refined);
    const double drift = check_kept(mesh_totals(mesh), mesh_totals(refined), 1e-9, what);
    if (report != nullptr)
      {
        report->called     = true;
        report->switches   = request.switches;
        report->new_points = refined.n_points() - mesh.n_points();
        report->cap_reached
          = parameters.steiner_points >= 0
            && report->new_points >= static_cast<unsigned long>(parameters.steiner_points);
        report->oversized_cells = count_oversized(refined, sizing.max_volume);
        report->volume_drift    = drift;
        report->seconds         = seconds_since(start);
      }
    return refined;
  }

  void
  warn_of_unmet_wishes(const TetgenReport &report, const core::Log &log)
  {
    if (report.cap_reached)
      log.warning("TetGen stopped at TetGen/Steiner points, before the wanted sizes were reached.");
    if (report.oversized_cells > 0)
      log.warning(std::to_string(report.oversized_cells)
                  + " tetrahedra are larger than asked for (look at TetGen/Keep boundary and "
                    "Steiner points).");
  }
} // namespace tetradapt::mesh
