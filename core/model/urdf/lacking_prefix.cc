#include "core/model/urdf/lacking_prefix.h"

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace armloom {
namespace {

// Counts the names for which `renamed` gives a name of the URDF.
template <class Rename>
std::size_t count_known(const std::set<std::string>& links, const std::set<std::string>& joints,
                        const RobotTree& tree, const Rename& renamed) {
  const auto count = [&](const std::set<std::string>& names, const auto& known) {
    return static_cast<std::size_t>(std::ranges::count_if(
        names, [&](const std::string& name) { return known.contains(renamed(name)); }));
  };
  return count(links, tree.by_link) + count(joints, tree.by_joint);
}

// Candidate prefixes, each with the number of sampled names that it fits.
using Candidates = std::map<std::string, std::size_t>;

// Counts the prefixes by which the name differs from names of the URDF: those that it lacks, and
// those that it has in excess.
template <class Names>
void add_candidates(const std::string& name, const Names& of_urdf, Candidates& lacking,
                    Candidates& extra) {
  for (const auto& [known, index] : of_urdf) {
    if (known.empty() || known.size() == name.size()) continue;
    if (known.ends_with(name))
      ++lacking[known.substr(0, known.size() - name.size())];
    else if (name.ends_with(known))
      ++extra[name.substr(0, name.size() - known.size())];
  }
}

// Returns the candidates that fit most of the sampled names. Bounds the time for large files.
std::vector<std::string> most_fitting(const Candidates& candidates) {
  constexpr std::size_t kMost = 8;
  std::vector<std::string> prefixes;
  for (const auto& [prefix, fits] : candidates) prefixes.push_back(prefix);
  std::ranges::stable_sort(prefixes, std::greater{},
                           [&](const std::string& prefix) { return candidates.at(prefix); });
  if (prefixes.size() > kMost) prefixes.resize(kMost);
  return prefixes;
}

std::string listed(const std::set<std::string>& prefixes) {
  std::string text;
  for (const std::string& prefix : prefixes) text += (text.empty() ? "" : " and with ") + prefix;
  return text;
}

}  // namespace

std::optional<PrefixMismatch> find_prefix_mismatch(const std::set<std::string>& links,
                                                   const std::set<std::string>& joints,
                                                   const RobotTree& tree) {
  PrefixMismatch mismatch;
  mismatch.names = links.size() + joints.size();
  const auto same = [](const std::string& name) { return name; };
  const std::size_t known = count_known(links, joints, tree, same);
  if (mismatch.names == 0 || tree.nameless || 2 * known > mismatch.names) return std::nullopt;

  constexpr std::size_t kSamples = 5;  // of each kind
  Candidates lacking;
  Candidates extra;
  const auto sample = [&](const std::set<std::string>& names, const auto& of_urdf) {
    std::size_t taken = 0;
    for (const std::string& name : names) {
      if (++taken > kSamples) break;
      add_candidates(name, of_urdf, lacking, extra);
    }
  };
  sample(links, tree.by_link);
  sample(joints, tree.by_joint);

  std::size_t best = std::max(known + 1, (9 * mismatch.names + 9) / 10);
  for (const std::string& prefix : most_fitting(lacking)) {
    const std::size_t count =
        count_known(links, joints, tree, [&](const std::string& name) { return prefix + name; });
    if (count < best) continue;
    if (count > best) mismatch.lacking.clear();
    best = count;
    mismatch.lacking.insert(prefix);
  }
  for (const std::string& prefix : most_fitting(extra)) {
    const std::size_t count = count_known(links, joints, tree, [&](const std::string& name) {
      return name.starts_with(prefix) ? name.substr(prefix.size()) : std::string();
    });
    if (count < best || !mismatch.lacking.empty()) continue;
    best = count;
    mismatch.extra = prefix;
  }
  mismatch.fitting = best;
  if (mismatch.lacking.empty() && !mismatch.extra) return std::nullopt;
  return mismatch;
}

std::string to_text(const PrefixMismatch& mismatch, const std::string& file, const std::string& key,
                    const RobotTree& tree) {
  const bool all = mismatch.fitting == mismatch.names;
  const std::string names = (all ? "all " : std::to_string(mismatch.fitting) + " of ") +
                            std::to_string(mismatch.names) + " names of joints and links in " +
                            file + " exist in " + tree.file;
  if (mismatch.extra) {
    return names + " without " + *mismatch.extra +
           " before them: make the URDF with this prefix, or remove it from " + file +
           ", for example with sed 's/\"" + *mismatch.extra + "/\"/g' " + file + " > new.srdf";
  }
  const std::string& first = *mismatch.lacking.begin();
  std::string option = "--" + key;
  std::ranges::replace(option, '_', '-');
  const std::string line = "add to the robot \"" + key + "\": \"" + first +
                           "\" (armloom import: " + option + " " + first + ")";
  if (mismatch.lacking.size() == 1) return names + " with " + first + " before them: " + line;
  return names + " with " + listed(mismatch.lacking) +
         " before them, so it describes one of several equal robots: write one file for all of "
         "them, "
         "or " +
         line + " to use only this one";
}

}  // namespace armloom
