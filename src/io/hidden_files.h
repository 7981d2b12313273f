// The hidden files that results grow in: their names, their locks, and which of them nobody will finish.
#pragma once

#include <ctime>
#include <string>

namespace rpf::io {

/// ".rpf-<host>-<process>-<n><extension>", n counted up in this process. The host is name and start of the machine, so
/// that no two of a farm are taken for one.
std::string hidden_name(const std::string& extension);

/// Whoever writes a hidden file holds a lock on it, which ends with the process. Returns false where the file system
/// has no locks, or with LOCK_NB in `how` where somebody holds it.
bool lock_hidden(int descriptor, int how);

/// Removes the hidden files in `folder` that no process of this host writes any more, and those of any host that are a
/// day older than `now`, in the clock of the folder's file system. On network disks locks may be local to a host, so a
/// lock that can be had proves nothing about the files of others.
void remove_abandoned(const std::string& folder, std::time_t now);

}  // namespace rpf::io
