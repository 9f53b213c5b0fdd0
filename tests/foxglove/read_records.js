// SPDX-License-Identifier: BSD-3-Clause
//
// Reads records with Foxglove's own libraries, by their index and as a stream, and decodes every
// message: node read_records.js FILE... It ends with an error at the first thing that is wrong.

"use strict";
const assert = require("node:assert");
const fs = require("node:fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { loadDecompressHandlers, protobufFromBinaryDescriptor } = require("@mcap/support");
const foxglove = require("@foxglove/schemas/internal");
const protobuf = require("protobufjs");

// What a record must have, whatever the flight.
const topics = ["/decisions", "/jobs", "/knobs", "/log", "/map", "/path", "/pose", "/power", "/rows", "/tf"];

function readable(file) {
  const bytes = fs.readFileSync(file);
  return {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  };
}

// Sequence numbers are a channel's own, so this names a message.
const nameOf = (message) => `${message.channelId} ${message.sequence}`;

async function readByIndex(file, decompressHandlers) {
  const reader = await McapIndexedReader.Initialize({ readable: readable(file), decompressHandlers });
  const messages = new Map();
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    assert(message.logTime >= last, "messages are not in the order of their times");
    last = message.logTime;
    messages.set(nameOf(message), message);
  }
  assert.equal(BigInt(messages.size), reader.statistics.messageCount, "statistics");
  const metadata = [];
  for await (const one of reader.readMetadata()) {
    metadata.push(one.name);
  }
  return { reader, messages, metadata };
}

function readAsStream(file, decompressHandlers) {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  const messages = new Map();
  const bytes = fs.readFileSync(file);
  const piece = 65_536;
  for (let at = 0; at < bytes.length; at += piece) {
    reader.append(bytes.subarray(at, at + piece));
    for (let record; (record = reader.nextRecord()); ) {
      if (record.type === "Message") {
        messages.set(nameOf(record), record);
      }
    }
  }
  assert(reader.done(), "the stream has no end");
  return messages;
}

// Every message decodes, and says its time; how many there are by topic.
function decodeAll({ reader, messages }) {
  const types = new Map();
  for (const schema of reader.schemasById.values()) {
    types.set(schema.id, protobufFromBinaryDescriptor(schema.data).lookupType(schema.name));
  }
  const counts = {};
  for (const message of messages.values()) {
    const channel = reader.channelsById.get(message.channelId);
    const decoded = types.get(channel.schemaId).decode(message.data);
    assert.equal(channel.messageEncoding, "protobuf");
    assert(decoded.timestamp, `a message of ${channel.topic} without its time`);
    counts[channel.topic] = (counts[channel.topic] ?? 0) + 1;
  }
  return { counts, types };
}

const shapeOf = (type) =>
  type.fieldsArray.map((field) => [
    field.id,
    field.name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`),
    field.repeated,
    field.type.replace(/^\.?(foxglove\.)?/, "").replace(/^.*\.(NumericType|Level)$/, "$1"),
  ]);

// Our tables of Foxglove's messages, against the .proto files that its package makes.
function compareSchemas(types) {
  let compared = 0;
  for (const type of types.values()) {
    for (const [name, schema] of Object.entries(foxglove.foxgloveMessageSchemas)) {
      let ours;
      try {
        ours = type.root.lookupType(`foxglove.${name}`);
      } catch {
        continue; // This message does not use it.
      }
      const enums = Object.values(foxglove.foxgloveEnumSchemas).filter(
        (one) => one.parentSchemaName === name,
      );
      const text = foxglove.generateProto(schema, enums);
      const theirs = protobuf.parse(text, { keepCase: true }).root.lookupType(`foxglove.${name}`);
      assert.deepEqual(shapeOf(ours), shapeOf(theirs), name);
      for (const one of theirs.nestedArray) {
        assert.deepEqual(ours.lookupEnum(one.name).values, one.values, `${name}.${one.name}`);
      }
      ++compared;
    }
  }
  assert(compared >= 10, `only ${compared} of Foxglove's messages were found`);
  return compared;
}

async function check(file, decompressHandlers) {
  const indexed = await readByIndex(file, decompressHandlers);
  const streamed = readAsStream(file, decompressHandlers);
  assert.equal(streamed.size, indexed.messages.size, "the two readers see other messages");
  for (const [name, message] of streamed) {
    assert.deepEqual(indexed.messages.get(name), message, `message ${name}`);
  }
  const { counts, types } = decodeAll(indexed);
  assert.deepEqual(Object.keys(counts).sort(), topics);
  const compared = compareSchemas(types);
  console.log(
    `${file}: ${streamed.size} messages in ${indexed.reader.chunkIndexes.length} chunks, the same by ` +
      `index and as a stream, all decoded; ${compared} descriptors as Foxglove has them; ` +
      `metadata ${indexed.metadata.join(", ")}`,
  );
}

async function main(files) {
  assert(files.length > 0, "which files?");
  const decompressHandlers = await loadDecompressHandlers();
  for (const file of files) {
    await check(file, decompressHandlers);
  }
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error);
  process.exit(1);
});
