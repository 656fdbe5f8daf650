// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/region_figures.h"

#include "tetradapt/mechanics/cauchy_stress.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::Point;

    /** Values that are equal but for this are held for the same. */
    constexpr double alike = 1e-6;

    /** Squares of stresses between these are exact to rounding. */
    constexpr double smallest_square = 1e-200, largest_square = 1e200;

    /** The square of the von Mises stress. */
    double
    square_of_von_mises(const SymmetricTensor<2, 3> &s)
    {
      const double xy    = s[0][0] - s[1][1];
      const double yz    = s[1][1] - s[2][2];
      const double zx    = s[2][2] - s[0][0];
      const double shear = s[0][1] * s[0][1] + s[1][2] * s[1][2] + s[0][2] * s[0][2];
      return 0.5 * (xy * xy + yz * yz + zx * zx) + 3. * shear;
    }

    double
    von_mises(const SymmetricTensor<2, 3> &stress)
    {
      const double square = square_of_von_mises(stress);
      if (square > smallest_square && square < largest_square)
        return std::sqrt(square);
      // Squares of very small and very large stresses leave the range.
      double scale = 0.;
      for (unsigned int i = 0; i < 6; ++i)
        scale = std::max(scale, std::abs(stress.access_raw_entry(i)));
      return scale == 0. ? 0. : scale * std::sqrt(square_of_von_mises(stress / scale));
    }

    /**
     * Displacement gradients at the four corners of a cell of degree 2. At corner v, shape
     * function i has the gradient (3 or -1) grad b_i, and the one of edge (v, j) has 4 grad b_j;
     * since the gradients of barycentric coordinates sum to zero, three of them suffice.
     */
    std::array<Tensor<2, 3>, 4>
    corner_gradients(const std::array<Tensor<1, 3>, 10> &u,
                     const std::array<Tensor<1, 3>, 4>  &directions)
    {
      // Of the vertices on the diagonal, of the edges next to it.
      std::array<std::array<Tensor<1, 3>, 4>, 4> values;
      for (unsigned int i = 0; i < 4; ++i)
        values[i][i] = u[i];
      for (unsigned int e = 0; e < 6; ++e)
        {
          const auto &[i, j] = mesh::edge_vertices[e];
          values[i][j] = values[j][i] = u[4 + e];
        }
      Tensor<2, 3> of_vertices;
      for (unsigned int j = 1; j < 4; ++j)
        of_vertices += outer_product(values[j][j] - values[0][0], directions[j]);
      std::array<Tensor<2, 3>, 4> result;
      for (unsigned int v = 0; v < 4; ++v)
        {
          result[v] = -of_vertices;
          for (unsigned int j = 1; j < 4; ++j)
            result[v] += outer_product(4. * (values[v][j] - values[v][0]), directions[j]);
        }
      return result;
    }

    bool
    is_before(const Point<3> &a, const Point<3> &b)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (a[d] != b[d])
          return a[d] < b[d];
      return false;
    }

    /** Stresses of cells, thermal strain taken off. */
    class Stresses
    {
    public:
      Stresses(const fem::Field &u, const MaterialMap &materials)
        : u(u), materials(materials), thermal(materials.has_thermal_strain())
      {
      }

      /** The largest von Mises stress of the k-th of the touching cells, and the corner that has
       * it; 4: all. */
      std::pair<double, unsigned int>
      largest(const unsigned int k)
      {
        const unsigned int cell = u.space().touching_cells()[k];
        u.values_of_cell(k, values_of_nodes);
        enter(u.mesh().regions[cell]);
        const auto directions = mesh::barycentric_gradients(u.mesh(), cell);
        if (u.degree() == 1)
          {
            Tensor<2, 3> G;
            for (unsigned int i = 0; i < 4; ++i)
              G += outer_product(values_of_nodes[i], directions[i]);
            return {von_mises(stress(thermal ? G - Tensor<2, 3>(mean_thermal_strain(cell)) : G)),
                    4};
          }
        auto                  gradients = corner_gradients(values_of_nodes, directions);
        std::array<double, 4> values; // squares first: one root a cell is enough
        for (unsigned int v = 0; v < 4; ++v)
          {
            if (thermal)
              gradients[v] -= Tensor<2, 3>(materials.thermal_strain(region, corner_of(cell, v)));
            values[v] = square(gradients[v]);
          }
        double     most      = *std::max_element(values.begin(), values.end());
        const bool has_range = most > smallest_square && most < largest_square;
        if (!has_range)
          {
            for (unsigned int v = 0; v < 4; ++v)
              values[v] = von_mises(stress(gradients[v]));
            most = *std::max_element(values.begin(), values.end());
          }
        // Rounding must not choose among corners whose values are the same.
        const double least  = (1. - (has_range ? 2. : 1.) * alike) * most;
        unsigned int corner = 4;
        for (unsigned int v = 0; v < 4; ++v)
          if (values[v] >= least
              && (corner == 4 || is_before(corner_of(cell, v), corner_of(cell, corner))))
            corner = v;
        return {has_range ? std::sqrt(most) : most, corner};
      }

    private:
      const Point<3> &
      corner_of(const unsigned int cell, const unsigned int i) const
      {
        return u.mesh().points[u.mesh().cells[cell][i]];
      }

      void
      enter(const int number)
      {
        if (law != nullptr && number == region)
          return;
        region = number;
        law    = &materials.law(region);
        linear = materials.is_linear() ? &materials.linear_law(region) : nullptr;
        mixed  = u.pressure() != nullptr;
        if (linear != nullptr)
          form = mixed ? materials.pressure_form(region) : linear->pressure_form();
      }

      SymmetricTensor<2, 3>
      stress(const Tensor<2, 3> &gradient) const
      {
        // A pressure has no part in the deviator.
        if (mixed && form)
          return form->stress(gradient, 0.);
        return linear != nullptr ? linear->stress(gradient) : cauchy_stress(*law, gradient);
      }

      /** The square of the von Mises stress. */
      double
      square(const Tensor<2, 3> &G) const
      {
        if (!form)
          return square_of_von_mises(stress(G));
        // The deviator of the stress is 2 mu times that of the strain.
        const double xy    = G[0][0] - G[1][1];
        const double yz    = G[1][1] - G[2][2];
        const double zx    = G[2][2] - G[0][0];
        const double a     = G[0][1] + G[1][0];
        const double b     = G[1][2] + G[2][1];
        const double c     = G[2][0] + G[0][2];
        const double twice = 2. * form->shear_modulus;
        return twice * twice
               * (0.5 * (xy * xy + yz * yz + zx * zx) + 0.75 * (a * a + b * b + c * c));
      }

      /** With the four points of the rule of degree 2, as report::mean_stresses(). */
      SymmetricTensor<2, 3>
      mean_thermal_strain(const unsigned int cell) const
      {
        const double          root = std::sqrt(5.);
        SymmetricTensor<2, 3> mean;
        for (unsigned int q = 0; q < 4; ++q)
          {
            Point<3> x;
            for (unsigned int i = 0; i < 4; ++i)
              x += (i == q ? 5. + 3. * root : 5. - root) / 20.
                   * Tensor<1, 3>(u.mesh().points[u.mesh().cells[cell][i]]);
            mean += 0.25 * materials.thermal_strain(region, x);
          }
        return mean;
      }

      const fem::Field            &u;
      const MaterialMap           &materials;
      std::array<Tensor<1, 3>, 10> values_of_nodes; ///< of a cell
      bool                         thermal, mixed = false;
      int                          region = 0;
      const ConstitutiveLaw       *law    = nullptr;
      const LinearLaw             *linear = nullptr; ///< the same; null for another law
      std::optional<PressureForm>  form;             ///< of the law, if it has one
    };

    /** Numbers the regions of a mesh from 0. */
    class RegionNumbers
    {
    public:
      explicit RegionNumbers(const std::vector<int> &regions)
      {
        for (const int region : regions)
          if (numbers.empty() || region != last->first)
            last = numbers.emplace(region, 0).first;
        unsigned int next = 0;
        for (auto &entry : numbers)
          entry.second = next++;
        last = numbers.begin();
      }
      unsigned int
      operator()(const int region)
      {
        if (last->first != region)
          last = numbers.find(region);
        return last->second;
      }
      const std::map<int, unsigned int> &
      all() const
      {
        return numbers;
      }

    private:
      std::map<int, unsigned int>           numbers;
      std::map<int, unsigned int>::iterator last;
    };

    /** A place among equals. */
    struct Candidate
    {
      bool     is_there = false;
      Point<3> place;

      void
      offer(const Point<3> &other)
      {
        if (!is_there || is_before(other, place))
          place = other;
        is_there = true;
      }
    };

    /** Puts the first of all ranks' candidates in @p places. */
    std::vector<Point<3>>
    first_of_ranks(const std::vector<Candidate> &mine, const MPI_Comm communicator)
    {
      std::vector<double> values;
      for (const Candidate &candidate : mine)
        {
          values.push_back(candidate.is_there ? 1. : 0.);
          for (unsigned int d = 0; d < 3; ++d)
            values.push_back(candidate.place[d]);
        }
      std::vector<Candidate> best(mine.size());
      for (const auto &rank : dealii::Utilities::MPI::all_gather(communicator, values))
        for (unsigned int k = 0; k < mine.size(); ++k)
          if (rank[4 * k] > 0.)
            best[k].offer(Point<3>(rank[4 * k + 1], rank[4 * k + 2], rank[4 * k + 3]));
      std::vector<Point<3>> places;
      for (const Candidate &candidate : best)
        places.push_back(candidate.place);
      return places;
    }

    /** Of the displacements, one a local node. */
    std::vector<double>
    lengths(const fem::Field &u)
    {
      std::vector<double> result(u.space().n_local_nodes());
      // Not by squares, which vanish for very small displacements.
      double scale = 0.;
      for (unsigned int node = 0; node < result.size(); ++node)
        for (unsigned int c = 0; c < 3; ++c)
          scale = std::max(scale, std::abs(u.value(node)[c]));
      // The same on any number of ranks.
      scale = dealii::Utilities::MPI::max(scale, u.space().communicator());
      for (unsigned int node = 0; node < result.size(); ++node)
        result[node] = scale > 0. ? scale * (u.value(node) / scale).norm() : 0.;
      return result;
    }

    /** What a rank finds in its cells. */
    class Search
    {
    public:
      Search(const fem::Field &u, const MaterialMap &materials)
        : u(u), space(u.space()), mesh(u.mesh()), communicator(space.communicator()),
          numbers(mesh.regions)
      {
        for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
          if (space.is_own_cell(k))
            own_cells.push_back(k);
        for (const auto &[region, number] : numbers.all())
          {
            RegionFigures figures;
            figures.region = region;
            if (const auto name = mesh.region_names.find(region); name != mesh.region_names.end())
              figures.name = name->second;
            result.push_back(figures);
          }
        displacement = lengths(u);
        measure(materials);
        find_places();
        for (RegionFigures &figures : result)
          figures.mass = materials.parameters(figures.region).density * figures.volume;
      }

      std::vector<RegionFigures> result;

    private:
      void
      measure(const MaterialMap &materials)
      {
        Stresses           stresses(u, materials);
        const unsigned int n_nodes = space.n_nodes_per_cell();
        stress.reserve(own_cells.size());
        displacement_of_cell.reserve(own_cells.size());
        for (const unsigned int k : own_cells)
          {
            const unsigned int cell    = space.touching_cells()[k];
            RegionFigures     &figures = result[numbers(mesh.regions[cell])];
            ++figures.n_cells;
            figures.volume += mesh::cell_volume(mesh, cell);
            stress.push_back(stresses.largest(k));
            figures.von_mises.value = std::max(figures.von_mises.value, stress.back().first);
            double most             = 0.;
            for (unsigned int i = 0; i < n_nodes; ++i)
              most = std::max(most, displacement[space.local_nodes_of(k)[i]]);
            displacement_of_cell.push_back(most);
            figures.displacement.value = std::max(figures.displacement.value, most);
          }
        for (RegionFigures &figures : result)
          {
            namespace MPI              = dealii::Utilities::MPI;
            figures.n_cells            = MPI::sum(figures.n_cells, communicator);
            figures.volume             = MPI::sum(figures.volume, communicator);
            figures.von_mises.value    = MPI::max(figures.von_mises.value, communicator);
            figures.displacement.value = MPI::max(figures.displacement.value, communicator);
          }
      }

      void
      find_places()
      {
        std::vector<Candidate> stressed(result.size()), displaced(result.size());
        for (unsigned int c = 0; c < own_cells.size(); ++c)
          {
            const unsigned int   k       = own_cells[c];
            const unsigned int   cell    = space.touching_cells()[k];
            const unsigned int   number  = numbers(mesh.regions[cell]);
            const RegionFigures &figures = result[number];
            const auto &[value, corner]  = stress[c];
            if (value >= (1. - alike) * figures.von_mises.value)
              stressed[number].offer(corner < 4 ? mesh.points[mesh.cells[cell][corner]]
                                                : centroid(cell));
            const double least = (1. - alike) * figures.displacement.value;
            if (!(displacement_of_cell[c] >= least))
              continue;
            for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
              if (displacement[space.local_nodes_of(k)[i]] >= least)
                displaced[number].offer(space.node_position(space.local_nodes_of(k)[i]));
          }
        const auto most_stressed  = first_of_ranks(stressed, communicator);
        const auto most_displaced = first_of_ranks(displaced, communicator);
        for (unsigned int k = 0; k < result.size(); ++k)
          {
            result[k].von_mises.place    = most_stressed[k];
            result[k].displacement.place = most_displaced[k];
          }
      }

      Point<3>
      centroid(const unsigned int cell) const
      {
        Point<3> x;
        for (const unsigned int p : mesh.cells[cell])
          x += 0.25 * Tensor<1, 3>(mesh.points[p]);
        return x;
      }

      const fem::Field                            &u;
      const fem::Space                            &space;
      const mesh::TetMesh                         &mesh;
      MPI_Comm                                     communicator;
      RegionNumbers                                numbers;
      std::vector<unsigned int>                    own_cells;    ///< among the touching ones
      std::vector<double>                          displacement; ///< lengths, one a local node
      std::vector<double>                          displacement_of_cell; ///< largest, rank's cells
      std::vector<std::pair<double, unsigned int>> stress;               ///< of the rank's cells
    };
  } // namespace

  std::vector<RegionFigures>
  compute_region_figures(const fem::Field &displacement, const MaterialMap &materials)
  {
    return Search(displacement, materials).result;
  }
} // namespace tetradapt::mechanics
