// SPDX-License-Identifier: MIT
// OSC 1.0 as splash speaks it, and its axes in Unity's.
using System;
using System.Collections.Generic;
using System.Text;

/// A message: an address and its arguments, each an int, a float or a string.
public sealed class SplashMessage
{
    public string Address;
    public readonly List<object> Arguments = new List<object>();

    public float Number(int index) { return Convert.ToSingle(Arguments[index]); }
}

public static class SplashOsc
{
    /// The messages of a packet; what is none is left out.
    public static List<SplashMessage> Parse(byte[] packet)
    {
        var messages = new List<SplashMessage>();
        try { Parse(packet, 0, packet.Length, messages); }
        catch (ArgumentException) { }           // cut short, or no OSC
        catch (IndexOutOfRangeException) { }
        return messages;
    }

    public static byte[] Build(string address, params object[] arguments)
    {
        var bytes = new List<byte>();
        var types = new StringBuilder(",");
        foreach (var argument in arguments) types.Append(argument is int ? 'i' : argument is float ? 'f' : 's');
        PutText(bytes, address);
        PutText(bytes, types.ToString());
        foreach (var argument in arguments)
        {
            if (argument is int) PutBytes(bytes, BitConverter.GetBytes((int)argument));
            else if (argument is float) PutBytes(bytes, BitConverter.GetBytes((float)argument));
            else PutText(bytes, (string)argument);
        }
        return bytes.ToArray();
    }

    /// splash has x ahead, y to the left and z up; Unity x to the right, y up and z ahead.
    public static void ToUnity(float x, float y, float z, out float ux, out float uy, out float uz)
    {
        ux = -y; uy = z; uz = x;
    }

    /// Mirrored axes turn the other way about the mirrored axis.
    public static float[] PoseFromUnity(float px, float py, float pz, float qx, float qy, float qz, float qw)
    {
        return new[] { pz, -px, py, -qz, qx, -qy, qw };
    }

    static void Parse(byte[] data, int at, int end, List<SplashMessage> messages)
    {
        int begin = at;
        string address = Text(data, ref at);
        if (address == "#bundle")
        {
            for (at = begin + 16; at + 4 <= end;)
            {
                int size = Int(data, ref at);
                if (size <= 0 || size > end - at) return;
                Parse(data, at, at + size, messages);
                at += size;
            }
            return;
        }
        string types = Text(data, ref at);
        var message = new SplashMessage { Address = address };
        foreach (char type in types.Substring(1))
        {
            if (type == 'i') message.Arguments.Add(Int(data, ref at));
            else if (type == 'f') message.Arguments.Add(BitConverter.ToSingle(Big(data, ref at, 4), 0));
            else if (type == 's') message.Arguments.Add(Text(data, ref at));
            else return;                         // nothing that events have
        }
        messages.Add(message);
    }

    static string Text(byte[] data, ref int at)
    {
        int end = Array.IndexOf(data, (byte)0, at);
        if (end < 0) throw new ArgumentException("a text without an end");
        string text = Encoding.ASCII.GetString(data, at, end - at);
        at += (end - at) / 4 * 4 + 4;
        return text;
    }

    static byte[] Big(byte[] data, ref int at, int count)
    {
        var bytes = new byte[count];
        Array.Copy(data, at, bytes, 0, count);
        if (BitConverter.IsLittleEndian) Array.Reverse(bytes);
        at += count;
        return bytes;
    }

    static int Int(byte[] data, ref int at) { return BitConverter.ToInt32(Big(data, ref at, 4), 0); }

    static void PutText(List<byte> bytes, string text)
    {
        bytes.AddRange(Encoding.ASCII.GetBytes(text));
        do bytes.Add(0); while (bytes.Count % 4 != 0);
    }

    static void PutBytes(List<byte> bytes, byte[] value)
    {
        if (BitConverter.IsLittleEndian) Array.Reverse(value);
        bytes.AddRange(value);
    }
}
