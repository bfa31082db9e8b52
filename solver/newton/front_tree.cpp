#include "solver/newton/front_tree.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace mammotwin {

namespace {

/// Equations of one mesh node.
struct Block {
  int first, width;
};

/// A front in the making: blocks eliminated together, and the later blocks they couple to.
struct Supernode {
  std::vector<int> pivots, structure, children;
  int pivot_width = 0, structure_width = 0;
  bool merged = false;
};

std::vector<Block> make_blocks(const std::vector<int>& node_of_equation) {
  std::vector<Block> blocks;
  for (int i = 0; i < static_cast<int>(node_of_equation.size()); ++i) {
    if (i == 0 || node_of_equation[i] != node_of_equation[i - 1]) blocks.push_back({i, 0});
    ++blocks.back().width;
  }
  return blocks;
}

/// Later blocks that each block's columns couple to.
std::vector<std::vector<int>> block_structure(const SparsePattern& pattern,
                                              const std::vector<Block>& blocks) {
  std::vector<int> block_of(pattern.num_columns());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    std::fill_n(block_of.begin() + blocks[b].first, blocks[b].width, static_cast<int>(b));
  std::vector<std::vector<int>> structure(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::set<int> rows;
    for (int c = blocks[b].first; c < blocks[b].first + blocks[b].width; ++c)
      for (int k = pattern.starts[c]; k < pattern.starts[c + 1]; ++k)
        rows.insert(block_of[pattern.rows[k]]);
    rows.erase(static_cast<int>(b));
    structure[b].assign(rows.begin(), rows.end());
  }
  return structure;
}

std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> sum;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(sum));
  return sum;
}

/// One supernode a block, with the fill of symbolic elimination.
std::vector<Supernode> eliminate(const std::vector<Block>& blocks,
                                 std::vector<std::vector<int>> structure) {
  std::vector<Supernode> nodes(blocks.size());
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
    Supernode& node = nodes[b];
    node.pivots = {b};
    node.structure = structure[b];
    node.pivot_width = blocks[b].width;
    for (int s : node.structure) node.structure_width += blocks[s].width;
    if (node.structure.empty()) continue;
    const int parent = node.structure.front();
    nodes[parent].children.push_back(b);
    auto passed_on = node.structure;
    passed_on.erase(passed_on.begin());
    structure[parent] = united(structure[parent], passed_on);
  }
  return nodes;
}

/// Worth it where few zeros are stored: more are borne in small fronts, whose BLAS calls are slow.
bool worth_merging(const Supernode& child, const Supernode& parent) {
  constexpr int small = 48, medium = 96;
  constexpr double small_zeros = 0.3, medium_zeros = 0.15, large_zeros = 0.05;
  const double width = child.pivot_width + parent.pivot_width;
  const double rows = width + parent.structure_width;
  const double zeros = double(child.pivot_width) *
                       (parent.pivot_width + parent.structure_width - child.structure_width);
  const double allowed = width <= small    ? small_zeros
                         : width <= medium ? medium_zeros
                                           : large_zeros;
  return zeros <= allowed * width * (rows - width / 2);
}

void merge(std::vector<Supernode>& nodes, int child, int parent) {
  Supernode &c = nodes[child], &p = nodes[parent];
  c.merged = true;
  c.pivots.insert(c.pivots.end(), p.pivots.begin(), p.pivots.end());
  p.pivots = std::move(c.pivots);
  p.pivot_width += c.pivot_width;
  std::erase(p.children, child);
  p.children.insert(p.children.end(), c.children.begin(), c.children.end());
}

void merge_all(std::vector<Supernode>& nodes) {
  for (int parent = 0; parent < static_cast<int>(nodes.size()); ++parent)
    for (bool again = true; again;) {
      again = false;
      for (int child : nodes[parent].children)
        if (worth_merging(nodes[child], nodes[parent])) {
          merge(nodes, child, parent);
          again = true;
          break;
        }
    }
}

void append_equations(const Block& block, std::vector<int>& equations) {
  for (int k = 0; k < block.width; ++k) equations.push_back(block.first + k);
}

/// Fronts in postorder; `position` receives each equation's place in the elimination.
int add_fronts(const std::vector<Supernode>& nodes, const std::vector<Block>& blocks, int root,
               FrontTree& tree, std::vector<int>& position, int& eliminated) {
  Front front;
  for (int child : nodes[root].children)
    front.children.push_back(add_fronts(nodes, blocks, child, tree, position, eliminated));
  for (int block : nodes[root].pivots) append_equations(blocks[block], front.equations);
  front.num_pivots = front.size();
  for (int equation : front.equations) position[equation] = eliminated++;
  for (int block : nodes[root].structure) append_equations(blocks[block], front.equations);
  tree.fronts.push_back(std::move(front));
  return static_cast<int>(tree.fronts.size()) - 1;
}

void sort_rest(FrontTree& tree, const std::vector<int>& position) {
  for (Front& front : tree.fronts)
    std::sort(front.equations.begin() + front.num_pivots, front.equations.end(),
              [&](int a, int b) { return position[a] < position[b]; });
}

/// Where each front's entries of the matrix go, and its update in the parent.
void link_front(const SparsePattern& pattern, const std::vector<std::vector<int>>& transposed,
                FrontTree& tree, Front& front, std::vector<int>& place,
                const std::vector<int>& position) {
  for (int k = 0; k < front.size(); ++k) place[front.equations[k]] = k;
  for (int child : front.children) {
    Front& c = tree.fronts[child];
    for (int k = c.num_pivots; k < c.size(); ++k) {
      c.to_parent.push_back(place[c.equations[k]]);
      append(k - c.num_pivots, c.to_parent.back(), 0, c.stretches_to_parent);
    }
  }
  const auto add = [&](int source, int row) {
    append(source, place[row], front.starts.back(), front.entries);
  };
  for (int p = 0; p < front.num_pivots; ++p) {
    const int pivot = front.equations[p];
    front.starts.push_back(static_cast<int>(front.entries.size()));
    for (int k = pattern.starts[pivot]; k < pattern.starts[pivot + 1]; ++k)
      if (position[pattern.rows[k]] >= position[pivot]) add(k, pattern.rows[k]);
    for (int k : transposed[pivot]) {  // entries of the pivot's row
      const int column =
          static_cast<int>(std::upper_bound(pattern.starts.begin(), pattern.starts.end(), k) -
                           pattern.starts.begin()) -
          1;
      if (position[column] > position[pivot]) add(k, column);
    }
  }
  front.starts.push_back(static_cast<int>(front.entries.size()));
}

/// Positions of the entries left of the diagonal, row by row; only rows that moved need them.
std::vector<std::vector<int>> row_entries(const SparsePattern& pattern,
                                          const std::vector<int>& position) {
  std::vector<std::vector<int>> entries(pattern.num_columns());
  for (int c = 0; c < pattern.num_columns(); ++c)
    for (int k = pattern.starts[c]; k < pattern.starts[c + 1]; ++k)
      if (position[pattern.rows[k]] < position[c]) entries[pattern.rows[k]].push_back(k);
  return entries;
}

}  // namespace

double FrontTree::flops() const {
  double sum = 0;
  for (const Front& front : fronts) {
    const double k = front.num_pivots, r = front.size() - k;
    sum += k * k * k / 3 + k * k * r + k * r * r;
  }
  return sum;
}

FrontTree make_front_tree(const SparsePattern& pattern, const std::vector<int>& node_of_equation) {
  const auto blocks = make_blocks(node_of_equation);
  auto nodes = eliminate(blocks, block_structure(pattern, blocks));
  merge_all(nodes);
  FrontTree tree;
  std::vector<int> position(pattern.num_columns()), place(pattern.num_columns());
  int eliminated = 0;
  for (int b = 0; b < static_cast<int>(nodes.size()); ++b)
    if (!nodes[b].merged && nodes[b].structure.empty())
      tree.roots.push_back(add_fronts(nodes, blocks, b, tree, position, eliminated));
  sort_rest(tree, position);
  const auto rows = row_entries(pattern, position);
  for (Front& front : tree.fronts) link_front(pattern, rows, tree, front, place, position);
  return tree;
}

}  // namespace mammotwin
