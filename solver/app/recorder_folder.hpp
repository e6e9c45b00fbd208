// OutputFolder: results appear under DIR only when they are good.
//
//   DIR/running   while they are being written (follow it with tail -f)
//   DIR           what a finished computation leaves
//   DIR/partial   an interrupted run: right as far as it goes
//   DIR/failed    a solve or run that stopped: for finding out why, never a result
#pragma once

#include <filesystem>
#include <string>

namespace hawser {

class OutputFolder {
 public:
  /// Throws InputError where `directory` cannot become a folder that we may write to. Creates nothing.
  explicit OutputFolder(std::filesystem::path directory);

  /// Creates DIR/running, and removes what an earlier command left in DIR/running, DIR/partial and DIR/failed.
  const std::filesystem::path& begin();

  /// Moves everything from DIR/running to DIR, replacing files of the same name; returns DIR.
  std::filesystem::path commit();

  /// Moves everything from DIR/running to DIR/`name` ("partial" or "failed"); returns it.
  std::filesystem::path keep_as(const std::string& name);

 private:
  std::filesystem::path move_to(const std::filesystem::path& target);

  std::filesystem::path directory_, running_;
};

}  // namespace hawser
