/* The messages as idlc names them, without module and version: the only place that knows those. */

#pragma once

#include "control.h"
#include "events.h"
#include "poses.h"
#include "reply.h"
#include "report.h"
#include "scene.h"
#include "wrench.h"

typedef poinsot_msg_v1_PoseFrame PoseFrame;
typedef poinsot_msg_v2_BodyDescription BodyDescription;
typedef poinsot_msg_v4_RunStatus RunStatus;
typedef poinsot_msg_v1_ImpactEvent ImpactEvent;
typedef poinsot_msg_v1_CommandReply CommandReply;
typedef poinsot_msg_v1_BodyWrench BodyWrench;
typedef poinsot_msg_v1_RunRequest RunRequest;

#define POSES_TYPE poinsot_msg_v1_PoseFrame_desc
#define SCENE_TYPE poinsot_msg_v2_BodyDescription_desc
#define REPORT_TYPE poinsot_msg_v4_RunStatus_desc
#define EVENTS_TYPE poinsot_msg_v1_ImpactEvent_desc
#define REPLY_TYPE poinsot_msg_v1_CommandReply_desc
#define WRENCH_TYPE poinsot_msg_v1_BodyWrench_desc
#define CONTROL_TYPE poinsot_msg_v1_RunRequest_desc

#define RESULT_OK poinsot_msg_v1_RESULT_OK
#define AXES_WORLD poinsot_msg_v1_AXES_WORLD
#define POINT_CENTER_OF_MASS poinsot_msg_v1_POINT_CENTER_OF_MASS
#define HOLD_DURATION poinsot_msg_v1_HOLD_DURATION
#define CONTROL_PAUSE poinsot_msg_v1_CONTROL_PAUSE
#define CONTROL_RESUME poinsot_msg_v1_CONTROL_RESUME
#define BODY_DYNAMIC poinsot_msg_v2_BODY_DYNAMIC
