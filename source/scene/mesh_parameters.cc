// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/mesh_parameters.h"

#include "binder.h"
#include "require.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::scene
{
  namespace
  {
    void
    bind(MeshParameters &p, Binder &binder)
    {
      binder("Type",
             p.source,
             word_codec<MeshSource>(),
             "Where the mesh comes from: a box, or blocks (a union of boxes), meshed by TetGen, a "
             "box of bricks cut into 6 "
             "tetrahedra each, a volume mesh from a file, or a closed surface from a file, "
             "meshed by TetGen.");
      binder("Lower corner",
             p.lower_corner,
             point_codec(),
             "box, bricks: corner with the smallest coordinates. The sides have the boundary "
             "ids 1 to 6 and the group names x-min, x-max, y-min, y-max, z-min, z-max.");
      binder("Upper corner",
             p.upper_corner,
             point_codec(),
             "box, bricks: corner with the largest coordinates.");
      binder("Cells",
             p.cells,
             bricks_codec(),
             "bricks: how many along x, y and z. Several, separated by commas, make a mesh list: "
             "one cycle each.");
      binder("Blocks",
             p.blocks,
             boxes_codec(),
             "blocks: boxes, each by its lower and upper corner, that touch but do not overlap. "
             "Outer faces have the ids and group names of a box, by their direction.");
      binder("Block regions",
             p.block_regions,
             ids_codec(),
             "blocks: the region id of each block; empty: 0 for all.");
      binder("Files",
             p.files,
             paths_codec(),
             "file: a volume mesh (.msh of version 2 or 4, .vtk, .vtu, .node with .ele); several, "
             "separated by semicolons, make a mesh list. surface: one closed surface (.stl, .off, "
             ".obj, .ply). Relative names count from the folder of the file that sets them.");
      binder("Surface edge length",
             p.surface_edge_length,
             number_codec(),
             "surface: edge length to which the surface is remeshed before TetGen meshes its "
             "inside; 0: it is taken as it is.");
      binder("Feature angle",
             p.feature_angle,
             number_codec(),
             "surface: edges where it bends by more than this many degrees are kept by the "
             "remeshing. Sliding supports, on any mesh: faces that meet at less share a normal.");
      binder("Volume bound",
             p.volume_bounds,
             numbers_codec(),
             "box, surface, file: largest volume of a tetrahedron that TetGen may leave; 0: no "
             "bound. Several, separated by commas, make a mesh list.");
      binder("Size",
             p.size,
             text_codec("an expression in x, y, z, or nothing"),
             "box, blocks, surface, file: wanted edge length, an expression in x, y, z; empty: "
             "none.");
      binder("Size field",
             p.size_field,
             text_codec("the name of a file, or nothing"),
             "box, blocks, surface, file: the size_field.vtu of an earlier run (of this scene with "
             "other loads or materials, or of a similar body) whose sizes the first mesh gets.");
      binder(
        "Projection",
        p.projection,
        word_codec<MeshParameters::Projection>(),
        "Where new points on a curved boundary go: they stay on the flat faces of the previous "
        "mesh (none), move to a fine triangulated surface, or to the zero set of an expression.");
      binder("Projection file",
             p.projection_file,
             text_codec("the name of a file, or nothing"),
             "surface: a closed surface (.stl, .off, .obj, .ply); empty: that of Files.");
      binder("Projection functions",
             p.projection_functions,
             expression_list_codec(),
             "expression: functions of x, y, z that vanish on the boundary, such as x^2 + y^2 + "
             "z^2 - 4; a face belongs to the first that vanishes at its corners, other faces stay "
             "flat.");
    }

    void
    bind(TetgenParameters &p, Binder &binder)
    {
      binder(
        "Radius-edge ratio",
        p.radius_edge_ratio,
        number_codec(),
        "Largest ratio of circumradius to shortest edge (-q). Smaller is stricter; at least 1.1. "
        "Meshes that follow a curved boundary (Mesh/Projection) are refined with 2 at least.");
      binder(
        "Minimum dihedral angle",
        p.dihedral_angle,
        number_codec(),
        "Smallest dihedral angle to aim at, in degrees (-q/), at most 20; 0: none. Not used for "
        "meshes that follow a curved boundary.");
      binder("Optimisation level",
             p.optimisation_level,
             count_codec(),
             "How much TetGen improves the quality at the end, 0 to 10 (-O).");
      binder("Optimisation scheme",
             p.optimisation_scheme,
             count_codec(),
             "Operations used for it, 0 to 7 (-O/): the sum of 1 flips, 2 smoothing, 4 vertex "
             "insertion.");
      binder("Steiner points",
             p.steiner_points,
             integer_codec(),
             "Largest number of points that one call may add (-S); -1: no limit. With a limit, "
             "sizes and quality may not be reached.");
      binder("Keep boundary",
             p.keep_boundary,
             yes_no_codec(),
             "No new points on the boundary (-Y). Not for adaptive refinement, which stalls "
             "with it.");
      binder("Time limit",
             p.time_limit,
             number_codec(),
             "Seconds after which a call is stopped and the run fails.");
      binder("Memory limit",
             p.memory_limit,
             number_codec(),
             "MiB that a call may use before the run fails.");
    }

    void
    check_corners(const MeshParameters &p)
    {
      double shortest = 1e300, longest = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double edge = p.upper_corner[d] - p.lower_corner[d];
          require(edge > 0.,
                  "Mesh/Upper corner",
                  std::string("its ") + "xyz"[d] + " coordinate " + text_of(p.upper_corner[d])
                    + " must be larger than the lower corner's, " + text_of(p.lower_corner[d])
                    + ". Exchange or correct them.");
          shortest = std::min(shortest, edge);
          longest  = std::max(longest, edge);
        }
      require(std::isfinite(longest), "Mesh/Upper corner", "the box is too large for a number.");
      // TetGen does not come to an end on a box that is nearly flat.
      require(p.source == MeshSource::bricks || shortest >= 1e-4 * longest,
              "Mesh/Upper corner",
              "the box is too flat for TetGen (edges " + text_of(shortest) + " and "
                + text_of(longest) + "). Use Type = bricks, or a thicker box.");
    }

    void
    check_cells(const MeshParameters &p)
    {
      require(!p.cells.empty(), "Mesh/Cells", "give at least one mesh, such as 2x2x12.");
      for (const auto &n : p.cells)
        {
          require(n[0] > 0 && n[1] > 0 && n[2] > 0,
                  "Mesh/Cells",
                  "there must be at least one brick in every direction.");
          require(6. * n[0] * n[1] * n[2] <= 1e8,
                  "Mesh/Cells",
                  brick_codec().write(n)
                    + " bricks are more than 100 million tetrahedra. Use fewer.");
        }
    }

    void
    check_files(const MeshParameters &p)
    {
      require(!p.files.empty(),
              "Mesh/Files",
              "a mesh of Type = " + word(p.source) + " needs the name of a file.");
      if (p.source == MeshSource::surface)
        {
          require(p.files.size() == 1,
                  "Mesh/Files",
                  "only one surface can be meshed. For a mesh list give several volume bounds.");
          check_file(p.files[0], "Mesh/Files", {".stl", ".off", ".obj", ".ply"});
          require(p.surface_edge_length >= 0.,
                  "Mesh/Surface edge length",
                  "must be positive, or 0 to take the surface as it is.");
          require(p.feature_angle > 0. && p.feature_angle <= 180.,
                  "Mesh/Feature angle",
                  "must be between 0 and 180 degrees; 60 is usual.");
          return;
        }
      for (const auto &file : p.files)
        check_file(file, "Mesh/Files", {".msh", ".vtk", ".vtu", ".node", ".ele"});
      require(p.files.size() == 1 || p.volume_bounds.size() == 1,
              "Mesh/Volume bound",
              "give a list of files or a list of volume bounds, not both.");
    }

    void
    check_blocks(const MeshParameters &p)
    {
      require(!p.blocks.empty(), "Mesh/Blocks", "give at least one box, such as 0,0,0 : 1,1,1.");
      for (std::size_t i = 0; i < p.blocks.size(); ++i)
        {
          const auto &[lower, upper] = p.blocks[i];
          const std::string which    = "block " + std::to_string(i + 1) + " ";
          for (unsigned int d = 0; d < 3; ++d)
            require(upper[d] > lower[d],
                    "Mesh/Blocks",
                    which + "ends at " + "xyz"[d] + " = " + text_of(upper[d])
                      + ", which is not above its beginning, " + text_of(lower[d])
                      + ". Exchange or correct them.");
          for (std::size_t j = 0; j < i; ++j)
            {
              bool overlap = true;
              for (unsigned int d = 0; d < 3; ++d)
                overlap
                  = overlap && p.blocks[j].first[d] < upper[d] && lower[d] < p.blocks[j].second[d];
              require(!overlap,
                      "Mesh/Blocks",
                      which + "overlaps block " + std::to_string(j + 1)
                        + ". Blocks may share faces only.");
            }
        }
      require(p.block_regions.empty() || p.block_regions.size() == p.blocks.size(),
              "Mesh/Block regions",
              "there are " + std::to_string(p.block_regions.size()) + " ids for "
                + std::to_string(p.blocks.size()) + " blocks. Give one each, or none.");
    }

    void
    check_projection(const MeshParameters &p)
    {
      using Projection = MeshParameters::Projection;
      if (p.projection == Projection::surface)
        {
          require(!p.projection_file.empty() || p.source == MeshSource::surface,
                  "Mesh/Projection file",
                  "Projection = surface needs the surface to project on.");
          if (!p.projection_file.empty())
            check_file(p.projection_file, "Mesh/Projection file", {".stl", ".off", ".obj", ".ply"});
        }
      if (p.projection == Projection::expression)
        {
          require(!p.projection_functions.empty(),
                  "Mesh/Projection functions",
                  "Projection = expression needs functions such as x^2 + y^2 + z^2 - 4.");
          for (const auto &function : p.projection_functions)
            check_expression(function, "Mesh/Projection functions");
        }
    }
  } // namespace

  void
  MeshParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  MeshParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  unsigned int
  MeshParameters::n_meshes() const
  {
    switch (source)
      {
      case MeshSource::bricks:
        return cells.size();
      case MeshSource::file:
        return std::max(files.size(), volume_bounds.size());
      default:
        return volume_bounds.size();
      }
  }

  void
  MeshParameters::check() const
  {
    Mistakes mistakes;
    if (source == MeshSource::box || source == MeshSource::bricks)
      {
        mistakes.attempt([&]() { check_corners(*this); });
        mistakes.require(files.empty(),
                         "Mesh/Files",
                         "a mesh of Type = " + word(source)
                           + " reads no file. Remove this, or set Type to file or surface.");
      }
    else if (source == MeshSource::blocks)
      mistakes.attempt([&]() { check_blocks(*this); });
    else
      mistakes.attempt([&]() { check_files(*this); });
    mistakes.attempt([&]() { check_projection(*this); });
    if (!size_field.empty())
      mistakes.attempt([&]() { check_file(size_field, "Mesh/Size field", {".vtu"}); });
    if (source != MeshSource::surface)
      mistakes.require(surface_edge_length == 0.,
                       "Mesh/Surface edge length",
                       "only a mesh of Type = surface has a surface to remesh. Remove this.");
    mistakes.require(!volume_bounds.empty(), "Mesh/Volume bound", "give a number; 0 is no bound.");
    for (const double bound : volume_bounds)
      mistakes.require(bound >= 0.,
                       "Mesh/Volume bound",
                       "a volume of " + text_of(bound)
                         + " is not possible: it must be positive, or 0 for no bound.");
    mistakes.attempt([&]() { check_size(size, "Mesh/Size"); });
    if (source == MeshSource::bricks)
      {
        mistakes.attempt([&]() { check_cells(*this); });
        mistakes.require(size_field.empty(),
                         "Mesh/Size field",
                         "the size of bricks is set by Cells. Remove this, or use Type = box.");
        mistakes.require(size.empty() && volume_bounds == std::vector<double>{0.},
                         size.empty() ? "Mesh/Volume bound" : "Mesh/Size",
                         "the size of bricks is set by Cells. Remove this, or use Type = box.");
      }
    mistakes.throw_together();
  }

  void
  TetgenParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  TetgenParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  TetgenParameters::check() const
  {
    Mistakes mistakes;
    mistakes.attempt([&]() { check_quality(radius_edge_ratio, dihedral_angle, "TetGen"); });
    mistakes.require(optimisation_level <= 10,
                     "TetGen/Optimisation level",
                     "must be a whole number from 0 to 10.");
    mistakes.require(optimisation_scheme <= 7,
                     "TetGen/Optimisation scheme",
                     "must be a whole number from 0 to 7.");
    mistakes.require(steiner_points >= -1,
                     "TetGen/Steiner points",
                     "must be a number of points, or -1 for no limit.");
    mistakes.require(time_limit > 0., "TetGen/Time limit", "must be a positive number of seconds.");
    mistakes.require(memory_limit >= 64.,
                     "TetGen/Memory limit",
                     "TetGen needs at least 64 MiB; the default is 8192.");
    mistakes.throw_together();
  }
} // namespace tetradapt::scene
