# The one list of Debian 12 packages, in groups. Sourced by install-packages.sh and i386-packages.sh.

# For building and running.
build_packages=(
    g++ cmake ninja-build pkg-config
    libeigen3-dev libexpected-dev            # vectors, result type
    libcgal-dev libtbb-dev                   # Delaunay triangulation, parallel stages
    libflatbuffers-dev flatbuffers-compiler  # MAP.vfs
    libxxhash-dev libzip-dev zlib1g-dev      # hashes, pk3 archives, compressed matches
    libassimp-dev liblzf-dev libnanoflann-dev  # meshes, compressed PCD, nearest neighbours in point clouds
    libembree-dev                            # the exact oracle
    libcairo2-dev                            # lettering and PNG of pictures
    cyclonedds-dev cyclonedds-tools          # the wire
    openssl libssl-dev                       # identities for DDS Security
    libspdlog-dev nlohmann-json3-dev libcli11-dev  # logging, JSON, command line
    libboost-dev prometheus-cpp-dev libsystemd-dev  # HTTP, metrics, service notification
    libjs-three                              # the page that shows matches: the server serves it
    libgtest-dev libgmock-dev librapidcheck-dev  # tests
    libqhull-dev                             # benchmarks: the paper's Voronoi engine
    libbullet-dev                            # benchmarks: sweeps beside the project's queries
)
# The map of the demo.
map_packages=(openarena-081-maps)
# Real games: OpenArena's server and client, and a display in memory with Mesa's software renderer; QuakeWorld's server
# and its mod with bots, for which Debian has no maps.
game_packages=(openarena-server openarena xvfb libgl1-mesa-dri mvdsv ktx)
# Videos of it.
film_packages=(ffmpeg)
# What test.sh needs in addition. Of prometheus it is promtool, which checks the alerts; nginx is the cache of broadcasts,
# wrk their viewers; iproute2 makes networks that can be cut, libfaketime clocks that can be stepped; nodejs and chromium
# (400 MB) run the page that shows matches; with ccache another checkout compiles only what differs.
test_packages=(
    clang-format-14 openarena-088-data prometheus nginx-light iproute2 libfaketime nodejs chromium
    wrk curl ccache
)
# kubectl builds the files for Kubernetes. Where it is another vendor's, Debian's package cannot be installed.
command -v kubectl >/dev/null || test_packages+=(kubernetes-client)
# What test.sh --all needs in addition.
lint_packages=(clang-14 clang-tidy-14 libclang-rt-14-dev shellcheck)
# For building Debian packages, and for testing them in an empty Debian.
package_packages=(dpkg-dev file debootstrap)
# What i386-packages.sh unpacks: the libraries of 32-bit game servers, and what to build against them.
i386_packages=(
    libc6 libc6-dev linux-libc-dev libgcc-s1 libgcc-12-dev libstdc++6 libstdc++-12-dev libeigen3-dev
    cyclonedds-dev libddsc0debian libcycloneddsidl0 libssl3
)
