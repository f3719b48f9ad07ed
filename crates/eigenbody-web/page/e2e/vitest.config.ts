import { defineConfig } from "vitest/config";

// One browser and one server at a time: the machine may be small, and a test that it was too busy for has a second try.
export default defineConfig({
  test: { include: ["e2e/**/*.e2e.ts"], testTimeout: 120_000, hookTimeout: 120_000, fileParallelism: false, retry: 1, reporters: ["verbose"] },
});
