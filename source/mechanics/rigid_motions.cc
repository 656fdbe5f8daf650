// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/mesh_checks.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /** A connected part: where it is and what its supports hold. */
    struct Part
    {
      Point<3>                             lower, upper;
      std::array<std::array<double, 6>, 6> gram{};
      unsigned int                         n_prescribed = 0;

      Point<3>
      centre() const
      {
        return lower + 0.5 * (upper - lower);
      }
    };

    /** Smallest relative singular value that counts as held. A support of two
     * points a thousandth of the body apart passes. */
    constexpr double held = 1e-8;

    std::string
    describe(const std::array<double, 6> &motion)
    {
      Tensor<1, 3> translation, rotation;
      for (unsigned int c = 0; c < 3; ++c)
        {
          translation[c] = motion[c];
          rotation[c]    = motion[3 + c];
        }
      const bool         turns     = rotation.norm() > 1e-4 * translation.norm();
      const Tensor<1, 3> direction = turns ? rotation / rotation.norm() : translation;
      std::ostringstream text;
      text.precision(2);
      text << (turns ? "turn about the direction (" : "move along (");
      for (unsigned int c = 0; c < 3; ++c)
        text << (c > 0 ? ", " : "") << (std::abs(direction[c]) < 1e-3 ? 0. : direction[c]);
      text << ")";
      return text.str();
    }

    void
    check_part(const Part &part, unsigned int n_parts)
    {
      dealii::LAPACKFullMatrix<double> gram(6, 6);
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          gram(i, j) = part.gram[i][j] / std::max(1u, part.n_prescribed);
      dealii::FullMatrix<double> vectors;
      dealii::Vector<double>     values;
      gram.compute_eigenvalues_symmetric(-1., 1e30, 0., values, vectors);
      if (values[0] > held * held)
        return;
      std::array<double, 6> motion;
      for (unsigned int k = 0; k < 6; ++k)
        motion[k] = vectors(k, 0);
      std::ostringstream message;
      message << "The supports do not hold ";
      if (n_parts > 1)
        message << "one of the " << n_parts << " separate parts of the body, the one ";
      else
        message << "the body ";
      message << "between " << mesh::to_string(part.lower) << " and "
              << mesh::to_string(part.upper);
      if (part.n_prescribed == 0)
        message << ": none of its nodes is supported";
      else
        message << ": it can still " << describe(motion);
      message << ". Add a support, or components to one, that prevents this.";
      throw core::InputError(message.str());
    }

    /** Adds what the supports of one node hold. */
    void
    add_node(const Point<3>               &x,
             const PrescribedDisplacement &prescribed,
             unsigned int                  node,
             Part                         &part)
    {
      const double length = 0.5 * (part.upper - part.lower).norm();
      ++part.n_prescribed;
      std::array<Tensor<1, 3>, 6> motions;
      for (unsigned int k = 0; k < 6; ++k)
        motions[k] = rigid_motion(k, x, part.centre(), length);
      for (unsigned int c = 0; c < 3; ++c)
        if (prescribed.is_fixed(node, c))
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              part.gram[i][j] += motions[i][c] * motions[j][c];
    }
  } // namespace

  Tensor<1, 3>
  rigid_motion(unsigned int k, const Point<3> &x, const Point<3> &centre, double length)
  {
    Tensor<1, 3> motion;
    if (k < 3)
      motion[k] = 1.;
    else
      {
        const Tensor<1, 3> r = (x - centre) / length;
        motion[(k + 1) % 3]  = -r[(k + 2) % 3];
        motion[(k + 2) % 3]  = r[(k + 1) % 3];
      }
    return motion;
  }

  void
  check_rigid_motions(const mesh::TetMesh &mesh, const PrescribedDisplacement &prescribed)
  {
    const std::vector<unsigned int> part_of = mesh::connected_components(mesh);
    std::vector<Part>               parts;
    // Mid-edge nodes follow their end points' supports, so vertices suffice. A point where
    // parts touch belongs to each.
    std::vector<std::pair<unsigned int, unsigned int>> supported; // part, point
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const unsigned int k = part_of[c];
        if (k >= parts.size())
          {
            parts.resize(k + 1);
            parts[k].lower = parts[k].upper = mesh.points[mesh.cells[c][0]];
          }
        for (const unsigned int p : mesh.cells[c])
          {
            for (unsigned int d = 0; d < 3; ++d)
              {
                parts[k].lower[d] = std::min(parts[k].lower[d], mesh.points[p][d]);
                parts[k].upper[d] = std::max(parts[k].upper[d], mesh.points[p][d]);
              }
            if (prescribed.fixed[p] != 0)
              supported.emplace_back(k, p);
          }
      }
    std::sort(supported.begin(), supported.end());
    supported.erase(std::unique(supported.begin(), supported.end()), supported.end());
    for (const auto &[k, p] : supported)
      add_node(mesh.points[p], prescribed, p, parts[k]);
    for (const Part &part : parts)
      check_part(part, parts.size());
  }
} // namespace tetradapt::mechanics
