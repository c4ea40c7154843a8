/* The messages as idlc names them, without module and version: the only place that knows those. */

#pragma once

#include "contacts.h"
#include "control.h"
#include "events.h"
#include "held.h"
#include "poses.h"
#include "reply.h"
#include "report.h"
#include "scene.h"
#include "wrench.h"

typedef poinsot_msg_v2_PoseFrame PoseFrame;
typedef poinsot_msg_v2_BodyMotion BodyMotion;
typedef poinsot_msg_v3_BodyDescription BodyDescription;
typedef poinsot_msg_v5_RunStatus RunStatus;
typedef poinsot_msg_v2_ImpactEvent ImpactEvent;
typedef poinsot_msg_v1_ContactFrame ContactFrame;
typedef poinsot_msg_v1_HeldWrenches HeldWrenches;
typedef poinsot_msg_v2_CommandReply CommandReply;
typedef poinsot_msg_v2_BodyWrench BodyWrench;
typedef poinsot_msg_v2_RunRequest RunRequest;

#define POSES_TYPE poinsot_msg_v2_PoseFrame_desc
#define SCENE_TYPE poinsot_msg_v3_BodyDescription_desc
#define REPORT_TYPE poinsot_msg_v5_RunStatus_desc
#define EVENTS_TYPE poinsot_msg_v2_ImpactEvent_desc
#define CONTACTS_TYPE poinsot_msg_v1_ContactFrame_desc
#define HELD_TYPE poinsot_msg_v1_HeldWrenches_desc
#define REPLY_TYPE poinsot_msg_v2_CommandReply_desc
#define WRENCH_TYPE poinsot_msg_v2_BodyWrench_desc
#define CONTROL_TYPE poinsot_msg_v2_RunRequest_desc

#define AXES_WORLD poinsot_msg_v1_AXES_WORLD
#define POINT_CENTER_OF_MASS poinsot_msg_v1_POINT_CENTER_OF_MASS
#define HOLD_DURATION poinsot_msg_v1_HOLD_DURATION
#define WRENCH_FORCE poinsot_msg_v1_WRENCH_FORCE
#define CONTROL_PAUSE poinsot_msg_v2_CONTROL_PAUSE
#define CONTROL_RESUME poinsot_msg_v2_CONTROL_RESUME
