// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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
      unsigned int                         n_prescribed = 0; ///< nodes
      std::array<std::array<double, 6>, 6> spring_gram{};
      double                               springs = 0.; ///< int tr K
      /** Of nodes with uncertain directions: what these hold, less what may be due to their
       * errors. */
      std::array<std::array<double, 6>, 6> uncertain{};
      std::array<std::array<double, 6>, 6> uncertain_held{}; ///< without that

      Point<3>
      centre() const
      {
        return lower + 0.5 * (upper - lower);
      }
    };

    using Matrix6 = std::array<std::array<double, 6>, 6>;

    /** Makes entry (p, q) of the symmetric @p a zero by a rotation of the two
     * directions, and turns the columns of @p vectors along. */
    void
    rotate(Matrix6 &a, Matrix6 &vectors, const unsigned int p, const unsigned int q)
    {
      if (a[p][q] == 0.)
        return;
      const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
      // The smaller of the two angles; for a huge theta it is 1 / (2 theta).
      const double t = std::copysign(1., theta) / (std::abs(theta) + std::hypot(theta, 1.));
      const double c = 1. / std::hypot(t, 1.), s = t * c;
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double kp = vectors[k][p], kq = vectors[k][q];
          vectors[k][p] = c * kp - s * kq;
          vectors[k][q] = s * kp + c * kq;
        }
    }

    /** The smallest eigenvalue of a symmetric matrix and its unit eigenvector, by
     * Jacobi's cyclic rotations (Golub, Van Loan, Matrix Computations, section 8.5).
     * LAPACK's search in an interval, which was used before, misses an eigenvalue that
     * is zero with some implementations of BLAS: then a body that is not held passed. */
    std::pair<double, std::array<double, 6>>
    smallest_eigenpair(Matrix6 a)
    {
      Matrix6 vectors{};
      for (unsigned int i = 0; i < 6; ++i)
        vectors[i][i] = 1.;
      // Convergence is quadratic: six sweeps are enough for rounding, ten are safe.
      for (unsigned int sweep = 0; sweep < 10; ++sweep)
        for (unsigned int p = 0; p < 6; ++p)
          for (unsigned int q = p + 1; q < 6; ++q)
            rotate(a, vectors, p, q);
      unsigned int smallest = 0;
      for (unsigned int i = 1; i < 6; ++i)
        if (a[i][i] < a[smallest][smallest])
          smallest = i;
      std::array<double, 6> vector;
      for (unsigned int k = 0; k < 6; ++k)
        vector[k] = vectors[k][smallest];
      return {a[smallest][smallest], vector};
    }

    /** Smallest relative singular value that counts as held. A support of two
     * points a thousandth of the body apart passes. */
    constexpr double held = 1e-8;
    /** The same with springs, whose normals are rounded: what those around a cylinder hold of its
     * turning is rounding. */
    constexpr double held_by_springs = 1e-6;

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

    /** What is held at all counts more than any unevenness of a wall. */
    constexpr double certainty = 1e8;

    /** Whether a motion that the certain supports leave moves a wall along itself, as far as its
     * faces tell where it is. Then only the unevenness of the faces would hold it. */
    void
    check_uncertain_part(const Part &part, const Matrix6 &gram)
    {
      if (part.uncertain == Matrix6{})
        return;
      Matrix6 weighted;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          weighted[i][j]
            = certainty * gram[i][j] + part.uncertain[i][j] / std::max(1u, part.n_prescribed);
      const auto [value, motion] = smallest_eigenpair(weighted);
      if (value > 0.)
        return;
      throw core::InputError(
        "The supports do not hold the body between " + mesh::to_string(part.lower) + " and "
        + mesh::to_string(part.upper) + ": it can still " + describe(motion)
        + ", as far as the directions in which faces slide are known; only the unevenness of these "
          "faces would hold it. Add a support, or components to one, that prevents this, or give "
          "the "
          "true surface by Mesh/Projection.");
    }

    void
    check_part(const Part &part, unsigned int n_parts)
    {
      Matrix6 gram = part.gram;
      for (auto &row : gram)
        for (double &entry : row)
          entry /= std::max(1u, part.n_prescribed);
      // As if the springs were one more kind of node: they hold what they hold, however soft.
      for (unsigned int i = 0; part.springs > 0. && i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          gram[i][j] += part.spring_gram[i][j] / part.springs;
      check_uncertain_part(part, gram);
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          gram[i][j] += part.uncertain_held[i][j] / std::max(1u, part.n_prescribed);
      const auto [value, motion] = smallest_eigenpair(gram);
      // Also false for NaN.
      const double least = part.springs > 0. ? held_by_springs : held;
      if (value > least * least)
        return;
      std::ostringstream message;
      message << "The supports do not hold ";
      if (n_parts > 1)
        message << "one of the " << n_parts << " separate parts of the body, the one ";
      else
        message << "the body ";
      message << "between " << mesh::to_string(part.lower) << " and "
              << mesh::to_string(part.upper);
      if (part.n_prescribed == 0 && part.springs == 0.)
        message << ": none of its nodes is supported";
      else
        message << ": it can still " << describe(motion);
      message << ". Add a support, or components to one, that prevents this.";
      throw core::InputError(message.str());
    }

    /** The components that supports fix at nodes whose other directions are uncertain. */
    std::map<unsigned int, unsigned char>
    certain_components(const PrescribedDisplacement &prescribed)
    {
      std::map<unsigned int, unsigned char> result;
      if (!prescribed.uncertainty.empty())
        for (const HeldNode &held : prescribed.held_nodes)
          if (prescribed.uncertainty.count(held.node) > 0)
            for (unsigned int c = 0; c < 3; ++c)
              if (held.components[c])
                result[held.node] |= 1u << c;
      return result;
    }

    /** Adds what the supports of one node hold. @param certain has components that are fixed for
     * sure where the node is inclined. */
    void
    add_node(const Point<3>               &x,
             const PrescribedDisplacement &prescribed,
             unsigned int                  node,
             const unsigned char           certain,
             Part                         &part)
    {
      const double length = 0.5 * (part.upper - part.lower).norm();
      ++part.n_prescribed;
      std::array<Tensor<1, 3>, 6> motions;
      for (unsigned int k = 0; k < 6; ++k)
        motions[k] = rigid_motion(k, x, part.centre(), length);
      for (unsigned int c = 0; c < 3; ++c)
        if (prescribed.is_fixed(node, c) || (certain >> c & 1) != 0)
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              part.gram[i][j] += motions[i][c] * motions[j][c];
      if (prescribed.fixed[node] == PrescribedDisplacement::is_inclined)
        {
          const SymmetricTensor<2, 3> &held  = prescribed.inclined.at(node);
          const auto                   error = prescribed.uncertainty.find(node);
          const bool                   known = error == prescribed.uncertainty.end();
          auto                        &gram  = known ? part.gram : part.uncertain_held;
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              {
                const double entry = motions[i] * (held * motions[j]);
                gram[i][j] += entry;
                if (!known)
                  part.uncertain[i][j]
                    += entry - error->second * error->second * (motions[i] * motions[j]);
              }
        }
    }

    /** Adds what is prescribed at a reference point, which counts as much as its nodes. */
    void
    add_coupling(const RigidCoupling &coupling, Part &part)
    {
      const double               length = 0.5 * (part.upper - part.lower).norm();
      std::array<RigidMotion, 6> motions; // of the reference point, rotations by length
      for (unsigned int k = 0; k < 6; ++k)
        {
          const auto t = rigid_motion(k, coupling.reference, part.centre(), length);
          for (unsigned int c = 0; c < 3; ++c)
            {
              motions[k][c]     = t[c];
              motions[k][3 + c] = k == 3 + c ? 1. : 0.;
            }
        }
      for (unsigned int c = 0; c < 6; ++c)
        if (coupling.prescribed[c])
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              part.gram[i][j] += coupling.nodes.size() * motions[i][c] * motions[j][c];
    }

    /** Parts that a coupling holds together count as one. */
    void
    join_coupled_parts(const mesh::TetMesh          &mesh,
                       const PrescribedDisplacement &prescribed,
                       std::vector<unsigned int>    &part_of)
    {
      for (const RigidCoupling &coupling : prescribed.rigid)
        {
          std::set<unsigned int> parts;
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (const unsigned int p : mesh.cells[c])
              if (std::binary_search(coupling.nodes.begin(), coupling.nodes.end(), p))
                parts.insert(part_of[c]);
          if (parts.size() > 1)
            for (unsigned int &part : part_of)
              if (parts.count(part) > 0)
                part = *parts.begin();
        }
      // Numbers without gaps, in the order of the first cells.
      std::map<unsigned int, unsigned int> numbers;
      for (unsigned int &part : part_of)
        part = numbers.emplace(part, numbers.size()).first->second;
    }

    /** Adds what the springs on one face hold. */
    void
    add_springs(const mesh::TetMesh &mesh, const Springs::Face &face, Part &part)
    {
      const double length = 0.5 * (part.upper - part.lower).norm();
      for (const Springs::Sample &point : face.points)
        {
          Point<3> x;
          for (unsigned int i = 0; i < 3; ++i)
            x += point.b[i] * Tensor<1, 3>(mesh.points[mesh.faces[face.face].vertices[i]]);
          std::array<Tensor<1, 3>, 6> motions;
          for (unsigned int k = 0; k < 6; ++k)
            motions[k] = rigid_motion(k, x, part.centre(), length);
          part.springs += point.weight * trace(point.stiffness);
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              part.spring_gram[i][j]
                += point.weight * (motions[i] * (point.stiffness * motions[j]));
        }
    }

    /** Of each boundary face, the cell that has it. */
    std::vector<unsigned int>
    cells_of_faces(const mesh::TetMesh &mesh)
    {
      std::vector<unsigned int> cells(mesh.faces.size(), 0);
      mesh::FaceTable(mesh).for_each_triangle(
        [&](const mesh::FaceTable::Entry *first, const mesh::FaceTable::Entry *last) {
          if (last - first == 2 && first[1].slot >= 4 * mesh.n_cells())
            cells[first[1].slot - 4 * mesh.n_cells()] = first->slot / 4;
        });
      return cells;
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

  namespace
  {
    /** What the supports and springs hold of each connected part. @param springs or null. */
    std::vector<Part>
    parts_of(const mesh::TetMesh          &mesh,
             const PrescribedDisplacement &prescribed,
             const Springs                *springs)
    {
      std::vector<unsigned int> part_of = mesh::connected_components(mesh);
      if (!prescribed.rigid.empty())
        join_coupled_parts(mesh, prescribed, part_of);
      std::vector<Part> parts;
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
      const auto components = certain_components(prescribed);
      for (const auto &[k, p] : supported)
        {
          const auto certain = components.find(p);
          add_node(mesh.points[p],
                   prescribed,
                   p,
                   certain == components.end() ? 0 : certain->second,
                   parts[k]);
        }
      for (const RigidCoupling &coupling : prescribed.rigid)
        {
          // All of its nodes belong to one part now.
          const auto at
            = std::find_if(supported.begin(), supported.end(), [&](const auto &part_and_point) {
                return part_and_point.second == coupling.nodes.front();
              });
          if (at != supported.end() && !coupling.basis.empty())
            add_coupling(coupling, parts[at->first]);
        }
      if (springs != nullptr && !springs->empty())
        {
          const auto cells = cells_of_faces(mesh);
          for (const Springs::Face &face : springs->faces())
            add_springs(mesh, face, parts[part_of[cells[face.face]]]);
        }
      return parts;
    }
  } // namespace

  void
  check_rigid_motions(const mesh::TetMesh          &mesh,
                      const PrescribedDisplacement &prescribed,
                      const Springs                *springs)
  {
    const std::vector<Part> parts = parts_of(mesh, prescribed, springs);
    for (const Part &part : parts)
      check_part(part, parts.size());
  }

  double
  least_stiffness(const mesh::TetMesh          &mesh,
                  const PrescribedDisplacement &prescribed,
                  const Springs                &springs,
                  const double                  fixed)
  {
    double least = fixed;
    for (const Part &part : parts_of(mesh, prescribed, &springs))
      {
        Matrix6 stiffness = part.spring_gram;
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            stiffness[i][j] += fixed * part.gram[i][j] / std::max(1u, part.n_prescribed);
        least = std::min(least, smallest_eigenpair(stiffness).first);
      }
    return least;
  }
} // namespace tetradapt::mechanics
