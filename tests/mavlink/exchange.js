// SPDX-License-Identifier: BSD-3-Clause
//
// node exchange.js PROGRAM KINDS SENT: compares ids, lengths and CRC extras with another library's,
// reads all that Flyball sent, and shows Flyball what that library writes. It ends with an error at the
// first thing that is wrong.

"use strict";
const assert = require("node:assert");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const { Readable } = require("node:stream");
const { common, minimal } = require("mavlink-mappings");
const {
  MavLinkPacketParser, MavLinkPacketSignature, MavLinkPacketSplitter, MavLinkProtocolV1, MavLinkProtocolV2,
} = require("node-mavlink");

const registry = { ...minimal.REGISTRY, ...common.REGISTRY };
const [program, kindsFile, sentFile] = process.argv.slice(2);

function compareKinds() {
  const lines = fs.readFileSync(kindsFile, "utf8").trim().split("\n");
  for (const line of lines) {
    const [id, length, crcExtra] = line.split(" ").map(Number);
    const theirs = registry[id];
    assert.deepEqual([id, length, crcExtra], [theirs.MSG_ID, theirs.PAYLOAD_LENGTH, theirs.MAGIC_NUMBER]);
  }
  return lines.length;
}

// Every byte belongs to a good frame, and every frame decodes to what a flight may ask for.
async function readSent() {
  const splitter = new MavLinkPacketSplitter({}, { onCrcError: () => assert.fail("a wrong checksum") });
  const bytes = fs.readFileSync(sentFile);
  const counts = {};
  let size = 0;
  for await (const packet of Readable.from([bytes]).pipe(splitter).pipe(new MavLinkPacketParser())) {
    const data = packet.protocol.data(packet.payload, registry[packet.header.msgid]);
    counts[data.constructor.MSG_NAME] = (counts[data.constructor.MSG_NAME] ?? 0) + 1;
    size += packet.buffer.length;
    checkSent(packet, data);
  }
  assert.equal(size, bytes.length, "bytes that belong to no frame");
  const names = ["COMMAND_LONG", "HEARTBEAT", "PARAM_REQUEST_READ", "SET_POSITION_TARGET_LOCAL_NED"];
  assert.deepEqual(Object.keys(counts).sort(), names);
  return counts;
}

function checkSent(packet, data) {
  assert.equal(packet.header.sysid, 1);
  assert.equal(packet.header.compid, minimal.MavComponent.ONBOARD_COMPUTER);
  if (data instanceof common.SetPositionTargetLocalNed) {
    assert.equal(data.coordinateFrame, common.MavFrame.LOCAL_NED);
    assert.equal(data.typeMask, common.PositionTargetTypemask.YAW_RATE_IGNORE);
    const numbers = [data.x, data.y, data.z, data.vx, data.vy, data.vz, data.afx, data.afy, data.afz, data.yaw];
    assert(numbers.every(Number.isFinite));
    // The stand-in calls its start (12, -7, .4), and flies 3 m to the east and 1.5 m to the south.
    assert(data.x > 10 && data.x < 12.1 && data.y > -7.1 && data.y < -3 && data.z > -2 && data.z < 0.5);
  } else if (data instanceof common.CommandLong) {
    const { MavCmd } = common;
    const asked = [MavCmd.SET_MESSAGE_INTERVAL, MavCmd.DO_SET_MODE, MavCmd.COMPONENT_ARM_DISARM,
      MavCmd.NAV_TAKEOFF, MavCmd.NAV_LAND];
    assert(asked.includes(data.command));
    assert.deepEqual([data.targetSystem, data.targetComponent], [1, 1]);
  } else if (data instanceof common.ParamRequestRead) {
    assert(["GUID_TIMEOUT", "WPNAV_ACCEL", "WP_ACC", "PSC_JERK_XY", "PSC_JERK_NE", "PSC_NE_JERK"]
      .includes(data.paramId));
    assert.equal(data.paramIndex, -1);
  } else {
    assert.equal(data.type, minimal.MavType.ONBOARD_CONTROLLER);
    assert.equal(data.autopilot, minimal.MavAutopilot.INVALID);
  }
}

const filled = (type, fields) => Object.assign(new type(), fields);

// What an autopilot says, and the line that Flyball prints of it.
const said = [
  [filled(minimal.Heartbeat, { type: 2, autopilot: 12, baseMode: 209, customMode: 0x60000, systemStatus: 4,
    mavlinkVersion: 3 }), [0, 0x60000, 2, 12, 209, 4, 3]],
  [filled(common.SysStatus, { onboardControlSensorsPresent: 1, onboardControlSensorsEnabled: 2,
    onboardControlSensorsHealth: 3, load: 500, voltageBattery: 22200, currentBattery: 1530, batteryRemaining: 83,
    dropRateComm: 4, errorsComm: 5, errorsCount1: 6, errorsCount2: 7, errorsCount3: 8, errorsCount4: 9 }),
  [1, 1, 2, 3, 500, 22200, 1530, 4, 5, 6, 7, 8, 9, 83]],
  [filled(common.ParamValue, { paramId: "GUID_TIMEOUT", paramValue: 0.5, paramType: 9, paramCount: 900,
    paramIndex: 77 }), [22, 0.5, 900, 77, "GUID_TIMEOUT", 9]],
  [filled(common.AttitudeQuaternion, { timeBootMs: 70000, q1: 0.5, q2: -0.5, q3: 0.25, q4: 0.75, rollspeed: 1.5,
    pitchspeed: -2.5, yawspeed: 3.5, reprOffsetQ: [0, 0, 0, 0] }),
  [31, 70000, 0.5, -0.5, 0.25, 0.75, 1.5, -2.5, 3.5, 0, 0, 0, 0]],
  [filled(common.LocalPositionNed, { timeBootMs: 70001, x: 1.5, y: -2.25, z: -3.75, vx: 0.5, vy: -0.25, vz: 8 }),
    [32, 70001, 1.5, -2.25, -3.75, 0.5, -0.25, 8]],
  [filled(common.CommandAck, { command: 400, result: 2, progress: 7, resultParam2: -5, targetSystem: 1,
    targetComponent: 191 }), [77, 400, 2, 7, -5, 1, 191]],
  [filled(common.ExtendedSysState, { vtolState: 0, landedState: 1 }), [245, 0, 1]],
  [filled(common.StatusText, { severity: 4, text: "low_battery", id: 5, chunkSeq: 1 }), [253, 4, "low_battery", 5, 1]],
];

function showSaid() {
  const plain = new MavLinkProtocolV2(1, 1);
  const signing = new MavLinkProtocolV2(1, 1, MavLinkProtocolV2.IFLAG_SIGNED);
  const key = MavLinkPacketSignature.key("flyball");
  const frames = [];
  const lines = [];
  for (const [message, fields] of said) {
    frames.push(plain.serialize(message, frames.length & 255));
    lines.push(fields.join(" "));
    frames.push(signing.sign(signing.serialize(message, frames.length & 255), 1, key));
    lines.push(fields.join(" ") + " signed");
  }
  // MAVLink 1 has no extensions, and fewer ids.
  frames.push(new MavLinkProtocolV1(1, 1).serialize(said[0][0], frames.length & 255));
  lines.push(said[0][1].join(" "));
  fs.writeFileSync("said.bin", Buffer.concat(frames));
  const printed = execFileSync(program, ["read", "said.bin"], { encoding: "utf8" });
  assert.deepEqual(printed.trim().split("\n"), lines);
  return lines.length;
}

async function main() {
  const kinds = compareKinds();
  const counts = await readSent();
  const read = showSaid();
  console.log(`${kinds} kinds agree; sent ${JSON.stringify(counts)}; read ${read} frames`);
}

main();
