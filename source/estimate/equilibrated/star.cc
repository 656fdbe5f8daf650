// SPDX-License-Identifier: AGPL-3.0-or-later
#include "star.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  void
  StarFlow::begin(const unsigned int n_cells)
  {
    n = n_cells;
    ways.clear();
    right.assign(3 * std::size_t(n), 0.);
  }

  void
  StarFlow::add_way(const unsigned int a, const unsigned int b, const double conductance)
  {
    ways.push_back({a, b, conductance});
  }

  void
  StarFlow::order_cells()
  {
    begins.assign(n + 1, 0);
    for (const Way &way : ways)
      if (way.b != outside)
        {
          ++begins[way.a + 1];
          ++begins[way.b + 1];
        }
    for (unsigned int i = 0; i < n; ++i)
      begins[i + 1] += begins[i];
    neighbors.resize(begins[n]);
    place.assign(begins.begin(), begins.end() - 1); // here: the next free entry
    for (const Way &way : ways)
      if (way.b != outside)
        {
          neighbors[place[way.a]++] = way.b;
          neighbors[place[way.b]++] = way.a;
        }
    order.clear();
    parts.clear();
    place.assign(n, outside);
    for (unsigned int start = 0; start < n; ++start)
      if (place[start] == outside)
        {
          parts.push_back(order.size());
          place[start] = order.size();
          order.push_back(start);
          for (unsigned int next = place[start]; next < order.size(); ++next)
            for (unsigned int k = begins[order[next]]; k < begins[order[next] + 1]; ++k)
              if (place[neighbors[k]] == outside)
                {
                  place[neighbors[k]] = order.size();
                  order.push_back(neighbors[k]);
                }
        }
    parts.push_back(n);
    has_way_out.assign(parts.size() - 1, 0);
    for (const Way &way : ways)
      if (way.b == outside)
        has_way_out[std::upper_bound(parts.begin(), parts.end(), place[way.a]) - parts.begin() - 1]
          = 1;
  }

  void
  StarFlow::factorise()
  {
    first_column.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      first_column[i] = i;
    for (const Way &way : ways)
      if (way.b != outside)
        {
          const unsigned int low = std::min(place[way.a], place[way.b]);
          unsigned int      &row = first_column[std::max(place[way.a], place[way.b])];
          row                    = std::min(row, low);
        }
    row_begin.resize(n);
    std::ptrdiff_t size = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        row_begin[i] = size - first_column[i];
        size += i - first_column[i] + 1;
      }
    matrix.assign(size, 0.);
    for (const Way &way : ways)
      {
        const unsigned int i = place[way.a];
        matrix[row_begin[i] + i] += way.conductance;
        if (way.b == outside)
          continue;
        const unsigned int j = place[way.b];
        matrix[row_begin[j] + j] += way.conductance;
        matrix[row_begin[std::max(i, j)] + std::min(i, j)] -= way.conductance;
      }
    // A part without a way out: the last potential is zero.
    for (unsigned int part = 0; part + 1 < parts.size(); ++part)
      if (!has_way_out[part])
        {
          const unsigned int last = parts[part + 1] - 1;
          for (unsigned int j = first_column[last]; j < last; ++j)
            matrix[row_begin[last] + j] = 0.;
          matrix[row_begin[last] + last] = 1.;
        }
    for (unsigned int i = 0; i < n; ++i)
      {
        double *row = matrix.data() + row_begin[i];
        for (unsigned int j = first_column[i]; j <= i; ++j)
          {
            const double *other = matrix.data() + row_begin[j];
            double        sum   = row[j];
            for (unsigned int k = std::max(first_column[i], first_column[j]); k < j; ++k)
              sum -= row[k] * other[k];
            row[j] = i == j ? std::sqrt(sum) : sum / other[j];
          }
      }
  }

  double
  StarFlow::solve(const unsigned int first, const unsigned int last)
  {
    order_cells();
    factorise();
    double       imbalance = 0.;
    unsigned int n_closed  = 0;
    ordered.resize(n);
    for (unsigned int part = 0; part + 1 < parts.size(); ++part)
      n_closed += has_way_out[part] ? 0 : 1;
    for (unsigned int c = first; c < last; ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          ordered[i] = right[3 * order[i] + c];
        for (unsigned int part = 0; part + 1 < parts.size(); ++part)
          if (!has_way_out[part])
            {
              double sum = 0.;
              for (unsigned int i = parts[part]; i < parts[part + 1]; ++i)
                sum += ordered[i];
              imbalance          = std::max(imbalance, std::abs(sum));
              const double share = sum / (parts[part + 1] - parts[part]);
              for (unsigned int i = parts[part]; i < parts[part + 1]; ++i)
                ordered[i] -= share;
              ordered[parts[part + 1] - 1] = 0.;
            }
        for (unsigned int i = 0; i < n; ++i)
          {
            const double *row = matrix.data() + row_begin[i];
            double        sum = ordered[i];
            for (unsigned int k = first_column[i]; k < i; ++k)
              sum -= row[k] * ordered[k];
            ordered[i] = sum / row[i];
          }
        for (unsigned int i = n; i-- > 0;)
          {
            const double *row = matrix.data() + row_begin[i];
            ordered[i] /= row[i];
            for (unsigned int k = first_column[i]; k < i; ++k)
              ordered[k] -= row[k] * ordered[i];
          }
        for (unsigned int i = 0; i < n; ++i)
          right[3 * order[i] + c] = ordered[i];
      }
    return parts.size() > 2 && n_closed > 0 ? imbalance : 0.;
  }
} // namespace tetradapt::estimate
