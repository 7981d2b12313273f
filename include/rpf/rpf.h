// Everything.
#pragma once

#include "rpf/conformance.h"
#include "rpf/devices.h"
#include "rpf/error.h"
#include "rpf/explain.h"
#include "rpf/filter.h"
#include "rpf/image.h"
#include "rpf/io.h"
#include "rpf/methods.h"
#include "rpf/metrics.h"
#include "rpf/outputs.h"
#include "rpf/samples.h"
#include "rpf/scene.h"
#include "rpf/settings.h"
#include "rpf/srgb.h"
#include "rpf/version.h"
