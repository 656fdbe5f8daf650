// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/saved_sizes.h"

#include "tetradapt/io/vtu_file.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::adapt
{
  namespace
  {
    constexpr char array_name[] = "size";

    /** TetGen makes about this many times the tetrahedra that sizes have on average, since
     * its bounds are upper ones; lengths taken from a mesh that it made are smaller
     * than those it was asked for by the cube root. Measured: 1.3 to 1.7. */
    constexpr double obtained_over_wanted = 1.6;
  } // namespace

  SavedSizes::SavedSizes(const std::string &name)
  {
    const io::VtuFile file(name);
    auto              mesh  = std::make_shared<mesh::TetMesh>(io::read_vtu(name));
    const auto        names = file.names("PointData");
    if (std::find(names.begin(), names.end(), array_name) == names.end())
      file.fail({}, "it has no point array 'size'; give the size_field.vtu of a run.");
    const auto array = file.array("PointData", array_name);
    sizes            = file.numbers(array, file.n_points());
    for (const double size : sizes)
      if (!(size > 0.) || !std::isfinite(size))
        file.fail(array, "an edge length is not positive and finite.");
    if (mesh::finalize(*mesh, "'" + name + "'").removed_points > 0)
      file.fail({}, "it has points that no cell names; give the size_field.vtu of a run.");
    locator = std::make_unique<compare::PointLocator>(mesh);
  }

  mesh::SizeFunction
  SavedSizes::for_box(const mesh::Point<3> &lower, const mesh::Point<3> &upper) const
  {
    const auto [own_lower, own_upper] = mesh::bounding_box(locator->mesh());
    mesh::Tensor<1, 3> shrink;
    double             stretch = std::cbrt(obtained_over_wanted);
    for (unsigned int d = 0; d < 3; ++d)
      {
        shrink[d] = (own_upper[d] - own_lower[d]) / (upper[d] - lower[d]);
        stretch /= std::cbrt(shrink[d]);
      }
    return [this, lower, origin = own_lower, shrink, stretch](const mesh::Point<3> &point) {
      mesh::Point<3> there = origin;
      for (unsigned int d = 0; d < 3; ++d)
        there[d] += shrink[d] * (point[d] - lower[d]);
      const compare::Location location = locator->locate(there);
      double                  size     = 0.;
      for (unsigned int i = 0; i < 4; ++i)
        size += location.barycentric[i] * sizes[locator->mesh().cells[location.cell][i]];
      return stretch * size;
    };
  }

  mesh::TetMesh
  mesh_with_saved_sizes(const mesh::Tetgen     &tetgen,
                        const mesh::TetMesh    &start,
                        const SavedSizes       &sizes,
                        const mesh::MeshChange &change,
                        mesh::SizeReport       *report)
  {
    const auto [lower, upper] = mesh::bounding_box(start);
    return mesh::mesh_with_size(tetgen, start, sizes.for_box(lower, upper), report, change, 0.4);
  }
} // namespace tetradapt::adapt
