#include "improvement/design/members.h"

namespace stackabilization::detail {

std::vector<std::vector<int>> members_of(DisjointSets& sets, std::size_t count) {
  std::vector<std::vector<int>> result;
  std::vector<std::size_t> number(count);  // number of a set, stored at its least member
  for (std::size_t member = 0; member < count; ++member) {
    const std::size_t root = sets.root(member);
    if (root == member) {
      number[member] = result.size();
      result.emplace_back();
    }
    result[number[root]].push_back(static_cast<int>(member));
  }
  return result;
}

}  // namespace stackabilization::detail
